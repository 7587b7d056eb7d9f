// One level in place of two: the coarser is drawn with the probability that it is weighed with.
// include "lod.wgsl"

fn draw_level(l: Levels, number: f32) -> i32 {
    return select(l.finer, l.coarser, number < l.fraction);
}
