// A folder that results go into.
#pragma once

#include <string>

namespace rawtexel::cli {

/// Made where it is missing, and taken away again when nothing came to be in it.
class OutputFolder {
  public:
    /// Throws scenes::OutputError where it cannot be made.
    explicit OutputFolder(std::string path);
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

    std::string operator/(const std::string& name) const { return path_ + "/" + name; }

  private:
    std::string path_;
    bool is_new_ = false;
};

}  // namespace rawtexel::cli
