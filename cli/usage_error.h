// Wrong use of the program: exit code 2.
#pragma once

#include <stdexcept>

namespace rawtexel::cli {

/// The command line asks for what does not exist or makes no sense. what() is one line, with the nearest valid spelling where there is one.
class UsageError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace rawtexel::cli
