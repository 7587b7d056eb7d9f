// What a right port answers to a case, and how far off a right one may be.
#pragma once

#include "cli/vectors/suite.h"
#include "texunit/draw.h"
#include "texunit/lookup_trace.h"

namespace rawtexel::cli {

/// How far a port's arithmetic may be off; the interval of legal values follows from it. Ports in 32-bit floats whose logarithms and square
/// roots are as good as Vulkan asks (SPIR-V "Precision and Operation of SPIR-V Instructions") stay within the defaults, with room to spare.
struct PortFreedom {
    float coordinate = 0x1p-12f;  ///< texels of level 0
    float derivative = 0x1p-12f;  ///< of itself
    float lod = 0x1p-9f;          ///< levels
    float number = 0x1p-16f;      ///< where a sum of weights may lie, seen from the number that is held against it
    float value = 0x1p-13f;       ///< of the largest that is added up, for rounding
};
/// Where every step is exact but for the last sums.
inline constexpr PortFreedom kExactFreedom{0, 0, 0, 0, 0x1p-13f};

/// The sampler of a case.
texunit::SamplerState sampler_of(const CaseRecord& record);
void set_sampler(const texunit::SamplerState& sampler, CaseRecord& record);

texunit::LaneCoordinates flat_coordinates(const CaseRecord& record);
texunit::LaneCoordinates3 solid_coordinates(const CaseRecord& record);

/// Every tap of a case, of a texture of any shape.
texunit::LookupTrace trace_case(const Suite& suite, const CaseRecord& record);

/// The answer of the texture unit itself. `lod_shift` is added to lambda before its bounds.
PortResult evaluate(const Suite& suite, const CaseRecord& record);

/// Which fields of the answer a case decides.
uint32_t judged_fields(const Suite& suite, const CaseRecord& record, const PortResult& expected);

/// The interval is the sum of what each of the freedoms does by itself. Nullopt where one of them changes a texel, a level or a count of
/// probes: such a case would say nothing.
std::optional<Expectation> expect(const Suite& suite, const CaseRecord& record, const PortFreedom& freedom = {});

}  // namespace rawtexel::cli
