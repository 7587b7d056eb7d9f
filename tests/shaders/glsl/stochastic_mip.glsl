// One level in place of two: the coarser is drawn with the probability that it is weighed with.
#ifndef STOCHASTIC_MIP_GLSL
#define STOCHASTIC_MIP_GLSL
#include "lod.glsl"

int draw_level(Levels l, float number) { return number < l.fraction ? l.coarser : l.finer; }

#endif
