// Files of what a frame fetched: its counts pixel by pixel, and every texel read.
#pragma once

#include "scenes/image_io.h"
#include "scenes/output_file.h"
#include "shading/render.h"
#include "texunit/fetch_trace.h"

#include <string>

namespace rawtexel::cli {

/// An OpenEXR file of the radiance and a layer for each count of FrameFetches::pixels. Throws scenes::OutputError.
void write_counts(const std::string& path, const shading::RenderResult& frame, const scenes::Placement& placement,
                  const scenes::Metadata& metadata);

/// A trace on its way to disk (docs/fetches.md).
class TraceFile {
  public:
    explicit TraceFile(const std::string& path);
    texunit::FetchTraceWriter& writer() { return writer_; }
    /// After the frame; without it nothing is left behind.
    void finish();

  private:
    scenes::OutputStream stream_;
    texunit::FetchTraceWriter writer_;
};

}  // namespace rawtexel::cli
