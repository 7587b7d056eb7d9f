// Is a colour among those that filtering may give? Families of colours, multilinear in coordinates and level fraction, are searched for
// one.
#pragma once

#include <array>
#include <cstddef>

namespace rawtexel::texunit {

using Colour = std::array<double, 4>;

struct Range {
    double low, high;
};

/// Colours that one level may give for coordinates within a stretch of each axis: bilinear between four, of volumes trilinear between
/// eight.
struct ColourPatch {
    size_t sides = 2;                ///< 2 or 3
    std::array<Colour, 8> corner{};  ///< [4*z + 2*y + x]
    Colour least{}, most{};          ///< of the corners, each channel by itself
    double bend = 0;                 ///< how far the colours themselves may be off the patch, in every channel
    size_t corners() const { return size_t{1} << sides; }
    /// Sets least and most.
    void find_bounds();
};

/// Looks for the colour closest to one that is wanted, until one is close enough.
class ColourSearch {
  public:
    /// Descent alone finds most colours that are there; only the whole search finds that one is not.
    enum class Effort { Descent, Whole };

    /// Close enough is within `threshold` in every channel.
    ColourSearch(const Colour& wanted, double threshold);

    /// All colours of one level's patch.
    void visit(const ColourPatch& patch);
    /// Those of two levels' patches of as many sides, mixed with a share of `coarser` within `share`; places in the two are independent.
    void visit(const ColourPatch& finer, const ColourPatch& coarser, Range share, Effort effort = Effort::Whole);

    /// Of the closest colour found: its largest difference of a channel in thresholds. At most 1: a legal one was found.
    double excess() const { return excess_; }
    const Colour& closest() const { return closest_; }
    /// Bounds of all colours visited, each channel by itself.
    const Colour& least() const { return least_; }
    const Colour& most() const { return most_; }

  private:
    /// Coordinates of a colour in its family: those of the finer patch, those of the coarser, share.
    static constexpr size_t kMostSides = 7;
    using Place = std::array<double, kMostSides>;
    using Box = std::array<Range, kMostSides>;

    Colour colour_at(const Place& place) const;
    double measure(const Colour& colour);
    bool can_improve(const Colour& least, const Colour& most);
    void search_family(const Box& box);
    void search(const Box& box);
    void descend(const Box& box, Place place);
    std::array<Colour, kMostSides> slopes(const Place& place) const;

    Colour wanted_;
    double threshold_;
    const ColourPatch* finer_ = nullptr;
    const ColourPatch* coarser_ = nullptr;  ///< null: one level
    size_t sides_ = 2;
    double bend_ = 0;     ///< of the family
    int boxes_left_ = 0;  ///< of the family
    int boxes_left_in_all_;

    double excess_;
    Colour closest_{}, least_, most_;
};

}  // namespace rawtexel::texunit
