// Prefiltering an environment: the octahedral maps of every roughness, made once from the lat-long image.
#pragma once

#include "shading/environment_tables.h"
#include "shading/executor.h"
#include "shading/image.h"

namespace rawtexel::shading {

/// Mean of the GGX lobe with n = v = r, cosine weighted, as a kernel of c = n.l: density over solid angle, 0 for c <= 0, integral 1.
/// D(h) n.l / (4 n.h) with (n.h)^2 = (1 + c)/2 is proportional to c / (1 - (1 - a^2)(1 + c)/2)^2; at a = 1 it is c/pi,
/// and as a grows beyond all bounds proportional to c / (1 + c)^2.
struct LobeKernel {
    explicit LobeKernel(double alpha);  ///< above 0; infinity: the last of these
    double normalisation;               ///< of c / (offset - slope*c)^2
    double offset, slope;
    double density(double cosine) const;
};

/// Fills scale, extent, start and texels from a 3-channel image. The same bits for any number of threads and on every instruction set.
void prefilter(const Image& latlong, Executor& executor, Environment::Tables& tables);

}  // namespace rawtexel::shading
