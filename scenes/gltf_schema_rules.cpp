#include "scenes/gltf_schema_rules.h"

#include "shading/scene.h"

namespace rawtexel::scenes {
namespace {

// In the order of the sections of glTF 2.0 chapter 5; extensions after the core.
constexpr double kPi = 3.14159265358979323846;
constexpr double kAboveZero = std::numeric_limits<float>::min();

constexpr Code kComponentTypes[] = {{5120, "BYTE"},           {5121, "UNSIGNED_BYTE"}, {5122, "SHORT"},
                                    {5123, "UNSIGNED_SHORT"}, {5125, "UNSIGNED_INT"},  {5126, "FLOAT"}};
constexpr Code kSparseIndexTypes[] = {{5121, "UNSIGNED_BYTE"}, {5123, "UNSIGNED_SHORT"}, {5125, "UNSIGNED_INT"}};
constexpr Code kFilters[] = {{9728, "NEAREST"}, {9729, "LINEAR"}};
constexpr Code kMinifications[] = {{9728, "NEAREST"},
                                   {9729, "LINEAR"},
                                   {9984, "NEAREST_MIPMAP_NEAREST"},
                                   {9985, "LINEAR_MIPMAP_NEAREST"},
                                   {9986, "NEAREST_MIPMAP_LINEAR"},
                                   {9987, "LINEAR_MIPMAP_LINEAR"}};
constexpr Code kWraps[] = {{33071, "CLAMP_TO_EDGE"}, {33648, "MIRRORED_REPEAT"}, {10497, "REPEAT"}};
constexpr Code kModes[] = {{0, "POINTS"},    {1, "LINES"},          {2, "LINE_LOOP"},   {3, "LINE_STRIP"},
                           {4, "TRIANGLES"}, {5, "TRIANGLE_STRIP"}, {6, "TRIANGLE_FAN"}};

constexpr Property kSparseIndices[] = {
    {.name = "bufferView", .kind = Kind::Index, .required = true, .refers_to = "bufferViews"},
    {.name = "byteOffset", .kind = Kind::Integer, .minimum = 0, .maximum = kMaxInt},
    {.name = "componentType", .kind = Kind::Integer, .required = true, .codes = kSparseIndexTypes},
};
constexpr Property kSparseValues[] = {
    {.name = "bufferView", .kind = Kind::Index, .required = true, .refers_to = "bufferViews"},
    {.name = "byteOffset", .kind = Kind::Integer, .minimum = 0, .maximum = kMaxInt},
};
constexpr ObjectRules kSparseIndicesRules{kSparseIndices}, kSparseValuesRules{kSparseValues};
constexpr Property kSparse[] = {
    {.name = "count", .kind = Kind::Integer, .required = true, .minimum = 1, .maximum = kMaxInt},
    {.name = "indices", .kind = Kind::Object, .required = true, .object = &kSparseIndicesRules},
    {.name = "values", .kind = Kind::Object, .required = true, .object = &kSparseValuesRules},
};
constexpr ObjectRules kSparseRules{kSparse};
constexpr Property kAccessor[] = {
    {.name = "name", .kind = Kind::Text},
    {.name = "bufferView", .kind = Kind::Index, .refers_to = "bufferViews"},
    {.name = "byteOffset", .kind = Kind::Integer, .minimum = 0, .maximum = kMaxSize},
    {.name = "componentType", .kind = Kind::Integer, .required = true, .codes = kComponentTypes},
    {.name = "normalized", .kind = Kind::Flag},
    {.name = "count", .kind = Kind::Integer, .required = true, .minimum = 1, .maximum = kMaxSize},
    {.name = "type", .kind = Kind::Text, .required = true},
    {.name = "sparse", .kind = Kind::Object, .object = &kSparseRules},
};
constexpr Property kAsset[] = {
    {.name = "version", .kind = Kind::Text, .required = true},
    {.name = "minVersion", .kind = Kind::Text},
};
constexpr Property kBuffer[] = {
    {.name = "name", .kind = Kind::Text},
    {.name = "uri", .kind = Kind::Text},
    {.name = "byteLength", .kind = Kind::Integer, .required = true, .minimum = 1, .maximum = kMaxSize},
};
constexpr Property kBufferView[] = {
    {.name = "name", .kind = Kind::Text},
    {.name = "buffer", .kind = Kind::Index, .required = true, .refers_to = "buffers"},
    {.name = "byteOffset", .kind = Kind::Integer, .minimum = 0, .maximum = kMaxSize},
    {.name = "byteLength", .kind = Kind::Integer, .required = true, .minimum = 1, .maximum = kMaxSize},
    {.name = "byteStride", .kind = Kind::Integer, .minimum = 4, .maximum = 252},
};
constexpr Property kOrthographic[] = {
    {.name = "xmag", .kind = Kind::Number, .required = true},
    {.name = "ymag", .kind = Kind::Number, .required = true},
    {.name = "zfar", .kind = Kind::Number, .required = true, .minimum = 0},
    {.name = "znear", .kind = Kind::Number, .required = true, .minimum = 0},
};
constexpr Property kPerspective[] = {
    {.name = "yfov",
     .kind = Kind::Number,
     .required = true,
     .minimum = 1e-6,
     .maximum = kPi - 1e-6,
     .allowed = "an angle in radians above 0 and below pi, 180\u00b0"},
    {.name = "znear", .kind = Kind::Number, .required = true, .minimum = kAboveZero, .allowed = "a number above 0"},
    {.name = "zfar", .kind = Kind::Number, .minimum = kAboveZero, .allowed = "a number above 0"},
};
constexpr ObjectRules kOrthographicRules{kOrthographic}, kPerspectiveRules{kPerspective};
constexpr Property kCamera[] = {
    {.name = "name", .kind = Kind::Text},
    {.name = "type", .kind = Kind::Text, .required = true},
    {.name = "orthographic", .kind = Kind::Object, .object = &kOrthographicRules},
    {.name = "perspective", .kind = Kind::Object, .object = &kPerspectiveRules},
};
constexpr Property kImage[] = {
    {.name = "name", .kind = Kind::Text},
    {.name = "uri", .kind = Kind::Text},
    {.name = "mimeType", .kind = Kind::Text},
    {.name = "bufferView", .kind = Kind::Index, .refers_to = "bufferViews"},
};

constexpr Property kTextureTransform[] = {
    {.name = "offset", .kind = Kind::Numbers, .length = 2},
    {.name = "rotation", .kind = Kind::Number},
    {.name = "scale", .kind = Kind::Numbers, .length = 2},
    {.name = "texCoord", .kind = Kind::Integer, .minimum = 0, .maximum = kMaxInt},
};
constexpr ObjectRules kTextureTransformRules{kTextureTransform};
constexpr Property kTextureInfoExtensions[] = {
    {.name = "KHR_texture_transform", .kind = Kind::Object, .object = &kTextureTransformRules},
};
constexpr ObjectRules kTextureInfoExtensionsRules{kTextureInfoExtensions};
constexpr Property kTextureInfo[] = {
    {.name = "index", .kind = Kind::Index, .required = true, .refers_to = "textures"},
    {.name = "texCoord", .kind = Kind::Integer, .minimum = 0, .maximum = kMaxInt},
    {.name = "scale", .kind = Kind::Number},
    {.name = "strength", .kind = Kind::Number, .minimum = 0, .maximum = 1},
    {.name = "extensions", .kind = Kind::Object, .object = &kTextureInfoExtensionsRules},
};
constexpr ObjectRules kTextureInfoRules{kTextureInfo};
constexpr Property kMetallicRoughness[] = {
    {.name = "baseColorFactor", .kind = Kind::Numbers, .length = 4, .minimum = 0},
    {.name = "baseColorTexture", .kind = Kind::Object, .object = &kTextureInfoRules},
    {.name = "metallicFactor", .kind = Kind::Number, .minimum = 0, .maximum = 1},
    {.name = "roughnessFactor", .kind = Kind::Number, .minimum = 0, .maximum = 1},
    {.name = "metallicRoughnessTexture", .kind = Kind::Object, .object = &kTextureInfoRules},
};
constexpr ObjectRules kMetallicRoughnessRules{kMetallicRoughness};
constexpr Property kEmissiveStrength[] = {
    {.name = "emissiveStrength", .kind = Kind::Number, .minimum = 0},
};
constexpr ObjectRules kEmissiveStrengthRules{kEmissiveStrength}, kEmptyRules{};
constexpr Property kMaterialExtensions[] = {
    {.name = "KHR_materials_emissive_strength", .kind = Kind::Object, .object = &kEmissiveStrengthRules},
    {.name = "KHR_materials_unlit", .kind = Kind::Object, .object = &kEmptyRules},
};
constexpr ObjectRules kMaterialExtensionsRules{kMaterialExtensions};
constexpr Property kPolicy[] = {
    {.name = "order", .kind = Kind::Text},
    {.name = "estimator", .kind = Kind::Text},
    {.name = "filter", .kind = Kind::Text},
    {.name = "mip", .kind = Kind::Text},
};
constexpr ObjectRules kPolicyRules{kPolicy, true};
constexpr Property kTriplanar[] = {
    {.name = "scale",
     .kind = Kind::Number,
     .required = true,
     .minimum = kAboveZero,
     .maximum = 1e6,
     .allowed = "a number above 0, at most 1e6"},
    {.name = "sharpness", .kind = Kind::Integer, .minimum = 1, .maximum = shading::kMostSharpness},
};
constexpr Property kLayers[] = {
    {.name = "materials", .kind = Kind::Indices, .required = true, .refers_to = "materials"},
    {.name = "mask", .kind = Kind::Object, .object = &kTextureInfoRules},
};
constexpr ObjectRules kTriplanarRules{kTriplanar}, kLayersRules{kLayers};
constexpr Property kMaterialRawtexel[] = {
    {.name = "triplanar", .kind = Kind::Object, .object = &kTriplanarRules},
    {.name = "layers", .kind = Kind::Object, .object = &kLayersRules},
    {.name = "policy", .kind = Kind::Object, .object = &kPolicyRules},
};
constexpr ObjectRules kMaterialRawtexelRules{kMaterialRawtexel};
constexpr Property kMaterialExtras[] = {
    {.name = "rawtexel", .kind = Kind::Object, .object = &kMaterialRawtexelRules},
};
constexpr ObjectRules kMaterialExtrasRules{kMaterialExtras};
constexpr Property kMaterial[] = {
    {.name = "name", .kind = Kind::Text},
    {.name = "pbrMetallicRoughness", .kind = Kind::Object, .object = &kMetallicRoughnessRules},
    {.name = "normalTexture", .kind = Kind::Object, .object = &kTextureInfoRules},
    {.name = "occlusionTexture", .kind = Kind::Object, .object = &kTextureInfoRules},
    {.name = "emissiveTexture", .kind = Kind::Object, .object = &kTextureInfoRules},
    {.name = "emissiveFactor", .kind = Kind::Numbers, .length = 3, .minimum = 0},
    {.name = "alphaMode", .kind = Kind::Text},
    {.name = "alphaCutoff", .kind = Kind::Number, .minimum = 0},
    {.name = "doubleSided", .kind = Kind::Flag},
    {.name = "extensions", .kind = Kind::Object, .object = &kMaterialExtensionsRules},
    {.name = "extras", .kind = Kind::Extras, .object = &kMaterialExtrasRules},
};

constexpr Property kPrimitive[] = {
    {.name = "attributes", .kind = Kind::IndexMap, .required = true, .refers_to = "accessors"},
    {.name = "indices", .kind = Kind::Index, .refers_to = "accessors"},
    {.name = "material", .kind = Kind::Index, .refers_to = "materials"},
    {.name = "mode", .kind = Kind::Integer, .codes = kModes},
    {.name = "targets", .kind = Kind::IndexMaps, .refers_to = "accessors"},
};
constexpr ObjectRules kPrimitiveRules{kPrimitive};
constexpr Property kMesh[] = {
    {.name = "name", .kind = Kind::Text},
    {.name = "primitives", .kind = Kind::Objects, .required = true, .object = &kPrimitiveRules},
    {.name = "weights", .kind = Kind::Numbers},
};

constexpr Property kNodeLight[] = {
    {.name = "light", .kind = Kind::Index, .required = true, .refers_to = "KHR_lights_punctual"},
};
constexpr ObjectRules kNodeLightRules{kNodeLight};
constexpr Property kNodeExtensions[] = {
    {.name = "KHR_lights_punctual", .kind = Kind::Object, .object = &kNodeLightRules},
};
constexpr ObjectRules kNodeExtensionsRules{kNodeExtensions};
constexpr Property kNode[] = {
    {.name = "name", .kind = Kind::Text},
    {.name = "camera", .kind = Kind::Index, .refers_to = "cameras"},
    {.name = "children", .kind = Kind::Indices, .refers_to = "nodes"},
    {.name = "skin", .kind = Kind::Index, .refers_to = "skins"},
    {.name = "matrix", .kind = Kind::Numbers, .length = 16},
    {.name = "mesh", .kind = Kind::Index, .refers_to = "meshes"},
    {.name = "rotation", .kind = Kind::Numbers, .length = 4},
    {.name = "scale", .kind = Kind::Numbers, .length = 3},
    {.name = "translation", .kind = Kind::Numbers, .length = 3},
    {.name = "weights", .kind = Kind::Numbers},
    {.name = "extensions", .kind = Kind::Object, .object = &kNodeExtensionsRules},
};
constexpr Property kSampler[] = {
    {.name = "name", .kind = Kind::Text},
    {.name = "magFilter", .kind = Kind::Integer, .codes = kFilters},
    {.name = "minFilter", .kind = Kind::Integer, .codes = kMinifications},
    {.name = "wrapS", .kind = Kind::Integer, .codes = kWraps},
    {.name = "wrapT", .kind = Kind::Integer, .codes = kWraps},
};
constexpr Property kSceneRawtexel[] = {
    {.name = "environment", .kind = Kind::Text},
};
constexpr ObjectRules kSceneRawtexelRules{kSceneRawtexel};
constexpr Property kSceneExtras[] = {
    {.name = "rawtexel", .kind = Kind::Object, .object = &kSceneRawtexelRules},
};
constexpr ObjectRules kSceneExtrasRules{kSceneExtras};
constexpr Property kScene[] = {
    {.name = "name", .kind = Kind::Text},
    {.name = "nodes", .kind = Kind::Indices, .refers_to = "nodes"},
    {.name = "extras", .kind = Kind::Extras, .object = &kSceneExtrasRules},
};
constexpr Property kSkin[] = {
    {.name = "name", .kind = Kind::Text},
    {.name = "inverseBindMatrices", .kind = Kind::Index, .refers_to = "accessors"},
    {.name = "joints", .kind = Kind::Indices, .required = true, .refers_to = "nodes"},
};
constexpr Property kTextureSource[] = {
    {.name = "source", .kind = Kind::Index, .refers_to = "images"},
};
constexpr ObjectRules kTextureSourceRules{kTextureSource};
constexpr Property kTextureExtensions[] = {
    {.name = "KHR_texture_basisu", .kind = Kind::Object, .object = &kTextureSourceRules},
    {.name = "MSFT_texture_dds", .kind = Kind::Object, .object = &kTextureSourceRules},
};
constexpr ObjectRules kTextureExtensionsRules{kTextureExtensions};
constexpr Property kTextureRawtexel[] = {
    {.name = "policy", .kind = Kind::Object, .object = &kPolicyRules},
};
constexpr ObjectRules kTextureRawtexelRules{kTextureRawtexel};
constexpr Property kTextureExtras[] = {
    {.name = "rawtexel", .kind = Kind::Object, .object = &kTextureRawtexelRules},
};
constexpr ObjectRules kTextureExtrasRules{kTextureExtras};
constexpr Property kTexture[] = {
    {.name = "name", .kind = Kind::Text},
    {.name = "sampler", .kind = Kind::Index, .refers_to = "samplers"},
    {.name = "source", .kind = Kind::Index, .refers_to = "images"},
    {.name = "extensions", .kind = Kind::Object, .object = &kTextureExtensionsRules},
    {.name = "extras", .kind = Kind::Extras, .object = &kTextureExtrasRules},
};

constexpr Property kAnimationTarget[] = {
    {.name = "node", .kind = Kind::Index, .refers_to = "nodes"},
    {.name = "path", .kind = Kind::Text, .required = true},
};
constexpr ObjectRules kAnimationTargetRules{kAnimationTarget};
constexpr Property kAnimationChannel[] = {
    {.name = "sampler", .kind = Kind::Integer, .required = true, .minimum = 0, .maximum = kMaxInt},
    {.name = "target", .kind = Kind::Object, .required = true, .object = &kAnimationTargetRules},
};
constexpr Property kAnimationSampler[] = {
    {.name = "input", .kind = Kind::Index, .required = true, .refers_to = "accessors"},
    {.name = "interpolation", .kind = Kind::Text},
    {.name = "output", .kind = Kind::Index, .required = true, .refers_to = "accessors"},
};
constexpr ObjectRules kAnimationChannelRules{kAnimationChannel}, kAnimationSamplerRules{kAnimationSampler};
constexpr Property kAnimation[] = {
    {.name = "name", .kind = Kind::Text},
    {.name = "channels", .kind = Kind::Objects, .required = true, .object = &kAnimationChannelRules},
    {.name = "samplers", .kind = Kind::Objects, .required = true, .object = &kAnimationSamplerRules},
};

constexpr std::string_view kConeAngle = "an angle in radians from 0 to pi/2, 90\u00b0";
constexpr Property kSpot[] = {
    {.name = "innerConeAngle", .kind = Kind::Number, .minimum = 0, .maximum = kPi / 2, .allowed = kConeAngle},
    {.name = "outerConeAngle", .kind = Kind::Number, .minimum = 0, .maximum = kPi / 2 + 1e-6, .allowed = kConeAngle},
};
constexpr ObjectRules kSpotRules{kSpot};
constexpr Property kLight[] = {
    {.name = "name", .kind = Kind::Text},
    {.name = "color", .kind = Kind::Numbers, .length = 3, .minimum = 0},
    {.name = "intensity", .kind = Kind::Number, .minimum = 0},
    {.name = "type", .kind = Kind::Text, .required = true},
    {.name = "range", .kind = Kind::Number, .minimum = 0},
    {.name = "spot", .kind = Kind::Object, .object = &kSpotRules},
};
constexpr ObjectRules kLightRules{kLight};
constexpr Property kLights[] = {
    {.name = "lights", .kind = Kind::Objects, .required = true, .object = &kLightRules},
};
constexpr ObjectRules kLightsRules{kLights};
constexpr Property kDocumentExtensions[] = {
    {.name = "KHR_lights_punctual", .kind = Kind::Object, .object = &kLightsRules},
};

constexpr ObjectRules kAccessorRules{kAccessor}, kAssetRules{kAsset}, kBufferRules{kBuffer}, kBufferViewRules{kBufferView},
    kCameraRules{kCamera}, kImageRules{kImage}, kMaterialRules{kMaterial}, kMeshRules{kMesh}, kNodeRules{kNode}, kSamplerRules{kSampler},
    kSceneRules{kScene}, kSkinRules{kSkin}, kTextureRules{kTexture}, kDocumentExtensionsRules{kDocumentExtensions};
constexpr ObjectRules kOneAnimationRules{kAnimation};
constexpr Property kAnimations[] = {
    {.name = "animations", .kind = Kind::Objects, .object = &kOneAnimationRules},
};
constexpr Property kDocument[] = {
    {.name = "asset", .kind = Kind::Object, .required = true, .object = &kAssetRules},
    {.name = "extensionsUsed", .kind = Kind::Texts},
    {.name = "extensionsRequired", .kind = Kind::Texts},
    {.name = "accessors", .kind = Kind::Objects, .object = &kAccessorRules},
    {.name = "buffers", .kind = Kind::Objects, .object = &kBufferRules},
    {.name = "bufferViews", .kind = Kind::Objects, .object = &kBufferViewRules},
    {.name = "cameras", .kind = Kind::Objects, .object = &kCameraRules},
    {.name = "images", .kind = Kind::Objects, .object = &kImageRules},
    {.name = "materials", .kind = Kind::Objects, .object = &kMaterialRules},
    {.name = "meshes", .kind = Kind::Objects, .object = &kMeshRules},
    {.name = "nodes", .kind = Kind::Objects, .object = &kNodeRules},
    {.name = "samplers", .kind = Kind::Objects, .object = &kSamplerRules},
    {.name = "scene", .kind = Kind::Index, .refers_to = "scenes"},
    {.name = "scenes", .kind = Kind::Objects, .object = &kSceneRules},
    {.name = "skins", .kind = Kind::Objects, .object = &kSkinRules},
    {.name = "textures", .kind = Kind::Objects, .object = &kTextureRules},
    {.name = "extensions", .kind = Kind::Object, .object = &kDocumentExtensionsRules},
};

}  // namespace

const ObjectRules kDocumentRules{kDocument}, kAnimationRules{kAnimations};

}  // namespace rawtexel::scenes
