// The check of a document against the shape that glTF 2.0 gives it (scenes/gltf_schema_rules.h).
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <stdexcept>
#include <string>

namespace rawtexel::scenes {

/// What is wrong with a document, without the file's name: "meshes[0].primitives[1].mode is "x" (allowed are integers)".
class SchemaError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// What of a document is not always read.
struct SchemaOptions {
    bool animations = false;
};

/// The part of `document` that the loader reads, every value of the right type, every index inside the array it points into, numbers as
/// doubles. Unknown properties, extensions and extras are left out. Throws SchemaError.
nlohmann::json checked_gltf(const nlohmann::json& document, const SchemaOptions& options = {});

}  // namespace rawtexel::scenes
