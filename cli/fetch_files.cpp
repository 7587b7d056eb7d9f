#include "cli/fetch_files.h"

namespace rawtexel::cli {

void write_counts(const std::string& path, const shading::RenderResult& frame, const scenes::Placement& placement,
                  const scenes::Metadata& metadata) {
    std::vector<shading::Layer> layers;
    for (int i = 0; i < shading::kPixelCounts; ++i) {
        const auto count = shading::PixelCount(i);
        const shading::Image& image = frame.fetches->pixel(count);
        if (image.width > 0) layers.push_back({std::string(to_string(count)), {"Y"}, image});
    }
    scenes::write_float(path, frame.radiance, layers, metadata, placement);
}

TraceFile::TraceFile(const std::string& path)
    : stream_(path), writer_([this](std::span<const std::byte> bytes) { stream_.write(bytes); }) {}

void TraceFile::finish() {
    writer_.end();
    stream_.finish();
}

}  // namespace rawtexel::cli
