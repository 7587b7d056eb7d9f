// Answers every case of a suite by the function `answer` of the shader that includes this.
#ifndef EACH_CASE_GLSL
#define EACH_CASE_GLSL
#include "contract.glsl"

Result answer(uint op, uint index);

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= case_count) return;
    index += first_case;
    write_result(index, answer(case_uint(index, CASE_OP), index));
}

#endif
