// Suites as files: a description in JSON and binary files beside it (docs/porting.md).
#pragma once

#include "cli/vectors/suite.h"

#include <string>

namespace rawtexel::cli {

/// The files of a suite, without folder.
inline constexpr const char* kSuiteFile = "suite.json";
inline constexpr const char* kCasesFile = "cases.bin";
inline constexpr const char* kExpectedFile = "expected.bin";
inline constexpr const char* kTexturesFile = "textures.bin";
inline constexpr const char* kTexelsFile = "texels.bin";
inline constexpr const char* kWordsFile = "words.bin";

/// Writes them into `folder`, made where it is missing, suite.json last. The same suite gives the same bytes. Throws scenes::OutputError.
void write_suite(const Suite& suite, const std::string& folder);

/// Throws scenes::InputError, naming the file: missing, of another version, sizes that do not agree, or texels, cases and fields beyond
/// what there is.
Suite read_suite(const std::string& folder);

/// Whether `folder` holds a suite.
bool is_suite_folder(const std::string& folder);

}  // namespace rawtexel::cli
