#include "cli/version.h"

namespace rawtexel::cli {

std::string_view version() { return RAWTEXEL_VERSION; }

}  // namespace rawtexel::cli
