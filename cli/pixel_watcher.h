// Writes down everything that happens at one pixel while it is rendered.
#pragma once

#include "cli/pixel_explanation.h"
#include "shading/fragment_listener.h"
#include "shading/render.h"
#include "shading/view_rays.h"

#include <vector>

namespace rawtexel::cli {

class PixelWatcher final : public shading::FragmentListener {
  public:
    /// Of pixel (x, y) of the frame that `options` describe. `lighting` is that of the frame and outlives the watcher.
    PixelWatcher(int x, int y, const shading::RenderOptions& options, const shading::Lighting& lighting);

    void judged(const shading::JudgedFragments& fragments) override;
    void masked(const shading::MaskedFragments& masked) override;
    void branched(const shading::BranchedFragments& branched) override;
    void tapped(const shading::TappedTexels& tapped) override;
    void shaded(const shading::ShadedFragments& fragments) override;
    void sampled(const shading::SampledPixels& pixels) override;

    /// The samples seen since it was asked last, in their order.
    std::vector<ExplainedSample> take();

  private:
    struct Judged {
        uint32_t setup_index;
        ExplainedCandidate candidate;
    };
    /// The pixel's lane, -1 where it is not among the block's.
    int lane_of(const shading::WatchedBlock& block) const;
    ExplainedSurface explain_surface(const shading::ShadedFragments& fragments, int lane);
    /// What is drawn at surfaces of `material`, at the number's address that its triangle has.
    std::vector<ExplainedNumber> numbers_of(const shading::MaterialState& material, const shading::WatchedBlock& block,
                                            uint32_t surface) const;
    void add_tap(const shading::ShadedFragments& fragments, int lane, ExplainedSurface& surface);
    AlphaVerdict verdict(const shading::JudgedFragments& fragments, int lane) const;
    /// Takes those of judged_ that let through what is seen at `depth`.
    std::vector<ExplainedCandidate> take_let_through(float depth);

    int x_, y_;
    shading::PixelFilter pixel_filter_;
    shading::PixelJitter pixel_jitter_;
    uint32_t seed_;
    shading::FilteringOptions filtering_;
    shading::ViewRays rays_;
    const shading::Lighting& lighting_;
    // Of the sample at hand.
    std::vector<Judged> judged_;
    std::optional<ExplainedSurface> surface_;
    std::vector<ExplainedSurface> branches_;         ///< of the surface that is told of next
    const shading::MaterialState* whole_ = nullptr;  ///< that what is told of is a plane or layer of
    bool branch_begins_ = false;                     ///< the last of them has nothing but its weight
    std::optional<ExplainedLookup> mask_;
    std::vector<ExplainedTexel> averaged_, texels_;  ///< of the surface, of the tap that is shaded next
    std::optional<ExplainedNumbers> numbers_;
    std::vector<ExplainedSample> samples_;
};

}  // namespace rawtexel::cli
