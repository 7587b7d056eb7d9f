#include "texunit/cache_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <list>
#include <random>
#include <set>

namespace rawtexel::texunit {
namespace {

/// Obviously right: every set a list of (line, sectors), most recent first.
class SlowCache {
  public:
    SlowCache(const CacheSpec& spec, const CacheLevelSpec& level, bool fully)
        : spec_(spec),
          lines_per_set_(fully || level.ways == 0 ? level.bytes / uint64_t(spec.line_bytes) : uint64_t(level.ways)),
          sets_(level.bytes / uint64_t(spec.line_bytes) / lines_per_set_) {}
    bool access(uint64_t address) {
        const uint64_t line = address / uint64_t(spec_.line_bytes);
        const uint64_t sector = address % uint64_t(spec_.line_bytes) / uint64_t(spec_.line_bytes / spec_.sectors);
        std::list<Line>& set = sets_[line % sets_.size()];
        const auto found = std::find_if(set.begin(), set.end(), [&](const Line& one) { return one.tag == line; });
        Line one{line, {}};
        if (found != set.end()) {
            one = *found;
            set.erase(found);
        }
        const bool hit = !one.sectors.insert(sector).second;
        set.push_front(one);
        if (set.size() > lines_per_set_) set.pop_back();
        return hit;
    }

  private:
    struct Line {
        uint64_t tag;
        std::set<uint64_t> sectors;
    };
    CacheSpec spec_;
    uint64_t lines_per_set_;
    std::vector<std::list<Line>> sets_;
};

/// Addresses that stay near one place for a while, as lookups do.
class Walk {
  public:
    explicit Walk(uint32_t seed) : random_(seed) {}
    uint64_t next() {
        if (random_() % 50 == 0) place_ = random_() % 20000;
        place_ = (place_ + random_() % 40) % 20000;
        return place_ / 4 * 4;
    }

  private:
    std::mt19937 random_;
    uint64_t place_ = 0;
};

class CacheModels : public testing::TestWithParam<const char*> {
  protected:
    CacheModels() {
        std::string error;
        spec = *parse_cache_spec(GetParam(), error);
    }
    CacheSpec spec;
};

TEST_P(CacheModels, AgreeWithListsAccessByAccess) {
    CacheModel model(spec);
    std::vector<SlowCache> l1(size_t(spec.cores), SlowCache(spec, spec.l1, false)),
        fully(size_t(spec.cores), SlowCache(spec, spec.l1, true));
    SlowCache l2(spec, spec.l2, false);
    std::vector<std::set<uint64_t>> seen(size_t(spec.cores));
    CacheCounts expected, found;
    Walk walk(7), behind(8);
    for (int i = 0; i < 60000; ++i) {
        const auto core = size_t(i / 1000 % spec.cores);
        const uint64_t first = walk.next(), second = behind.next();
        const bool fully_hit = fully[core].access(first);
        if (l1[core].access(first)) {
            ++expected.l1_hits;
        } else {
            ++expected.l1_misses;
            const bool is_new = seen[core].insert(first / uint64_t(spec.line_bytes / spec.sectors)).second;
            ++(is_new ? expected.compulsory : fully_hit ? expected.conflict : expected.capacity);
            ++(l2.access(second) ? expected.l2_hits : expected.l2_misses);
        }
        model.access(int(core), first, second, found);
        ASSERT_EQ(found, expected) << "access " << i;
    }
    EXPECT_EQ(found.l1_hits + found.l1_misses, 60000u);
    EXPECT_EQ(found.l2_hits + found.l2_misses, found.l1_misses);
    EXPECT_EQ(found.compulsory + found.capacity + found.conflict, found.l1_misses);
    EXPECT_GT(found.l1_hits, 0u);
    EXPECT_GT(found.capacity, 0u);
}

INSTANTIATE_TEST_SUITE_P(Shapes, CacheModels,
                         testing::Values("l1=1K:2,l2=4K:4", "l1=1K:full,l2=8K:full", "l1=3K:4,l2=12K:3", "line=32,l1=512:1,l2=2K:2",
                                         "line=128,sectors=4,l1=2K:2,l2=8K:4,cores=3", "line=256,sectors=16,l1=1K:full,l2=4K:2"));

TEST(CacheModel, TellsTheThreeCausesApart) {
    std::string error;
    const CacheSpec spec = *parse_cache_spec("line=64,l1=256:1,l2=1K:2", error);  // four sets of one line
    CacheModel model(spec);
    CacheCounts counts;
    const auto read = [&](uint64_t line) { model.access(0, 64 * line, 64 * line, counts); };
    read(0), read(4), read(0);  // the same set: the third is a conflict
    EXPECT_EQ(counts, (CacheCounts{0, 3, 1, 2, 2, 0, 1}));
    for (const uint64_t line : {1, 2, 3, 5}) read(line);  // line 0 leaves even a fully associative cache
    read(4);
    EXPECT_EQ(counts.capacity, 1u);
    EXPECT_EQ(counts.compulsory, 6u);
}

TEST(CacheModel, FillsOneSectorAMiss) {
    std::string error;
    CacheModel model(*parse_cache_spec("line=64,sectors=4,l1=1K:2,l2=1K:2", error));
    CacheCounts counts;
    model.access(0, 0, 0, counts);
    model.access(0, 12, 12, counts);  // the same 16 bytes
    model.access(0, 16, 16, counts);  // the same line, not there yet
    EXPECT_EQ(counts.l1_hits, 1u);
    EXPECT_EQ(counts.compulsory, 2u);
}

TEST(CacheSpec, KeepsDefaultsAndPrintsAllOfItself) {
    std::string error;
    const auto spec = parse_cache_spec("line=64,l1=16K:8,l2=256K:16,cores=1,holds=decoded", error);
    ASSERT_TRUE(spec) << error;
    EXPECT_EQ(spec->l2_holds, CacheContent::Decoded);
    EXPECT_EQ(to_string(*spec), "line=64,sectors=1,l1=16K:8,l2=256K:16,cores=1,holds=decoded:decoded");
    EXPECT_EQ(to_string(CacheSpec{}), "line=64,sectors=1,l1=16K:8,l2=256K:16,cores=1,holds=decoded:stored");
    for (const char* const text : {"l1=1M:full,l2=768:3", "sectors=2,line=128,cores=4,holds=stored:decoded"}) {
        const auto other = parse_cache_spec(text, error);
        ASSERT_TRUE(other) << text << ": " << error;
        EXPECT_EQ(parse_cache_spec(to_string(*other), error), other) << text;
    }
}

TEST(CacheSpec, SaysWhatIsWrong) {
    for (const auto& [text, expected] : {std::pair{"", "unknown field ''"},
                                         {"lines=64", "unknown field 'lines'"},
                                         {"line=65", "65 bytes a line"},
                                         {"line=8", "8 bytes a line"},
                                         {"line=8192", "'line=8192'"},
                                         {"sectors=8", "8 sectors"},
                                         {"l1=16K:0", "'l1=16K:0'"},
                                         {"l1=1000:8", "l1 of 1000 bytes"},
                                         {"l2=0", "l2 of 0 bytes"},
                                         {"l1=16X", "'l1=16X'"},
                                         {"l1=99999999999999999999", "'l1="},
                                         {"cores=0", "'cores=0'"},
                                         {"cores=257", "'cores=257'"},
                                         {"holds=all", "'holds=all'"},
                                         {"l1", "'l1'"},
                                         {"line=64,,cores=1", "unknown field ''"}}) {
        std::string error;
        EXPECT_FALSE(parse_cache_spec(text, error)) << text;
        EXPECT_NE(error.find(expected), std::string::npos) << text << ": " << error;
    }
}

}  // namespace
}  // namespace rawtexel::texunit
