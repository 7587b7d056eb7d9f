// What a load tells about things it leaves out: each once per file.
#pragma once

#include "scenes/load.h"

#include <set>
#include <string>
#include <utility>

namespace rawtexel::scenes {

class GltfNotices {
  public:
    GltfNotices(std::string path, const LoadOptions& options) : path_(std::move(path)), warn_(options.warn) {}

    void say_once(const std::string& what) {
        if (said_.insert(what).second) warn_(path_ + ": " + what);
    }

  private:
    std::string path_;
    std::function<void(const std::string&)> warn_;
    std::set<std::string> said_;
};

}  // namespace rawtexel::scenes
