// The shape that glTF 2.0 gives its JSON, as tables: chapter 5 and the extensions that are honoured.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string_view>

namespace rawtexel::scenes {

/// Integers up to these: in a double every one is exact, in an int every one fits.
inline constexpr double kMaxSize = 9007199254740992.0, kMaxInt = 2147483647.0;

/// What a value may be.
enum class Kind {
    Flag,     ///< true or false
    Integer,  ///< within minimum..maximum, and one of `codes` if there are any
    Index,    ///< into the document's array `refers_to`
    Number,
    Text,
    Numbers,  ///< array of numbers, `length` of them if that is not 0
    Indices,  ///< array of indices into `refers_to`
    Texts,
    Object,     ///< by the rules of `object`
    Objects,    ///< array of such
    IndexMap,   ///< object of indices into `refers_to`
    IndexMaps,  ///< array of such
    Extras,     ///< an object by the rules of `object`, left out when it is anything else
};

struct ObjectRules;

/// One of the numbers that stand for names, as in OpenGL.
struct Code {
    int value;
    std::string_view name;
};

struct Property {
    std::string_view name;
    Kind kind = Kind::Flag;
    bool required = false;
    std::string_view refers_to = {};
    const ObjectRules* object = nullptr;
    size_t length = 0;
    double minimum = -std::numeric_limits<double>::infinity(), maximum = std::numeric_limits<double>::infinity();
    std::span<const Code> codes = {};
    std::string_view allowed = {};  ///< for messages, where the bounds would not read well
};

struct ObjectRules {
    std::span<const Property> properties;
    bool closed = false;  ///< no other properties are allowed; glTF itself lets them be
};

/// Of the whole document, but for its animations; and of these.
extern const ObjectRules kDocumentRules, kAnimationRules;

}  // namespace rawtexel::scenes
