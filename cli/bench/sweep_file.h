// What a sweep has finished, on disk: where --resume goes on.
#pragma once

#include "cli/bench/measurement.h"

#include <string>
#include <utility>
#include <vector>

namespace rawtexel::cli {

/// Options as they were given, by name.
using GivenOptions = std::vector<std::pair<std::string, std::string>>;

/// A file of the texts that a scene was read from, as it was.
struct SceneFile {
    std::string path;
    uint64_t bytes = 0;
    int64_t changed = 0;  ///< nanoseconds
    bool operator==(const SceneFile&) const = default;
};

/// One JSON object a line, the whole file written anew under another name and renamed after each result: it is never half there.
class SweepFile {
  public:
    /// A new sweep. `settings`: everything that its numbers follow from. Nothing is written before begin().
    SweepFile(std::string path, GivenOptions settings);
    /// One that was interrupted. Throws scenes::InputError where the file cannot be read or is damaged, and UsageError where it is missing
    /// or holds a sweep with other settings.
    static SweepFile resumed(std::string path, GivenOptions settings);
    /// Whether `path` holds a sweep that did not end.
    static bool is_interrupted(const std::string& path);

    /// Null where it was not finished.
    const Truth* truth(const std::string& scene, const std::string& filter) const;
    const Measurement* measurement(const std::string& scene, const std::string& options) const;
    size_t finished() const { return measurements_.size(); }

    void begin();
    void add(Truth truth);
    void add(Measurement measurement);
    /// Notes what a scene was read from; throws UsageError where that is not what it was before.
    void check_files(const std::string& scene, const std::vector<std::string>& paths);
    void end();

  private:
    SweepFile() = default;
    void note(const nlohmann::ordered_json& line);
    void write() const;
    void read_line(const nlohmann::ordered_json& line);

    struct SceneFiles {
        std::string scene;
        std::vector<SceneFile> files;
    };

    std::string path_, text_;
    std::vector<Truth> truths_;
    std::vector<Measurement> measurements_;
    std::vector<SceneFiles> scenes_;
};

}  // namespace rawtexel::cli
