// Files that appear whole or not at all.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

namespace rawtexel::scenes {

/// Writes `bytes` under a temporary name beside the file that `path` leads to and renames it to that file; nothing is left behind on
/// failure. Throws OutputError (scenes/image_io.h): no such folder, not writable, no space.
void write_file(const std::string& path, std::span<const std::byte> bytes);

/// The same piece by piece, for what does not fit into memory.
class OutputStream {
  public:
    explicit OutputStream(const std::string& path);
    /// Without `finish`, nothing is left behind.
    ~OutputStream();
    OutputStream(const OutputStream&) = delete;
    OutputStream& operator=(const OutputStream&) = delete;

    void write(std::span<const std::byte> bytes);
    void finish();

  private:
    class Target;
    class TemporaryFile;
    class SpecialFile;
    std::unique_ptr<Target> target_;
};

/// Throws the OutputError that write_file would throw at once, to be asked before long work. Leaves nothing behind and changes no file.
void check_writable(const std::string& path);

/// Where write_file puts what it writes to `path`: links stay and their targets are written. Throws OutputError when links lead in a
/// circle.
std::string written_path(const std::string& path);

/// True for what exists and is neither file nor folder: devices such as /dev/null are written to, not replaced.
bool is_special(const std::string& path);

}  // namespace rawtexel::scenes
