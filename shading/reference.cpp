#include "shading/reference.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>
#include <vector>

namespace rawtexel::shading {
namespace {

/// Mean and spread of batches, value by value (Welford 1962).
class BatchStatistics {
  public:
    explicit BatchStatistics(size_t values) : mean_(values), squares_(values) {}

    void add(std::span<const float> batch) {
        ++batches_;
        for (size_t i = 0; i < mean_.size(); ++i) {
            const double value = double(batch[i]), before = value - mean_[i];
            mean_[i] += before / batches_;
            squares_[i] += before * (value - mean_[i]);
        }
    }
    int batches() const { return batches_; }
    /// Root mean square over the values of the mean's standard error.
    double standard_error() const {
        double sum = 0;
        for (const double squares : squares_) sum += squares / (batches_ - 1) / batches_;
        return std::sqrt(sum / double(squares_.size()));
    }
    void store_mean(std::span<float> out) const {
        std::ranges::transform(mean_, out.begin(), [](double value) { return float(value); });
    }

  private:
    std::vector<double> mean_, squares_;
    int batches_ = 0;
};

}  // namespace

RenderOptions reference_options(RenderOptions options) {
    options.mip = texunit::MipMode::None;
    options.footprint = {};
    options.footprint.probes = 1;
    options.precision = texunit::Precision::Exact;
    options.pixel_jitter = PixelJitter::Pixel;
    options.filtering = {};
    options.filtering.order = FilterOrder::After;
    return options;
}

Reference render_reference(const Scene& scene, const Lighting& lighting, const RenderOptions& options, const ReferenceGoal& goal,
                           Executor& executor, const Progress& progress) {
    assert(goal.error > 0 && goal.most_samples >= 2 * kReferenceBatch);
    RenderOptions batch = reference_options(options);
    batch.spp = kReferenceBatch;
    Reference reference;
    reference.result = render(scene, lighting, batch, executor);
    BatchStatistics statistics(reference.result.radiance.values.size());
    statistics.add(reference.result.radiance.values);

    const int most = goal.most_samples / kReferenceBatch;
    for (int next = 4; statistics.batches() < most; next *= 2) {
        while (statistics.batches() < std::min(next, most)) {
            batch.first_sample = options.first_sample + uint32_t(statistics.batches() * kReferenceBatch);
            batch.fetches = {};
            batch.aovs.clear();
            const RenderResult result = render(scene, lighting, batch, executor);
            statistics.add(result.radiance.values);
            reference.result.samples_shaded += result.samples_shaded;
            // The error falls with the root of the samples.
            if (progress && reference.standard_error > 0) {
                const double needed = statistics.batches() * std::pow(reference.standard_error / goal.error, 2);
                progress(std::min(double(statistics.batches()) / std::min(std::max(needed, double(next)), double(most)), 1.0));
            }
        }
        reference.standard_error = statistics.standard_error();
        if (reference.standard_error < goal.error) break;
    }
    statistics.store_mean(reference.result.radiance.values);
    reference.samples = statistics.batches() * kReferenceBatch;
    return reference;
}

}  // namespace rawtexel::shading
