#include "cli/reports/plot.h"

#include "cli/option_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace rawtexel::cli {
namespace {

constexpr double kLeft = 72, kTop = 40, kBottom = 56;  ///< beside the axes
constexpr double kInnerWidth = 468, kLeastHeight = 420;
constexpr double kLegendRow = 18, kLegendGlyph = 44;  ///< what a row's line takes before its name
constexpr double kLeastRight = 180, kLetter = 6.4;    ///< the legend's room on the right, by the longest name
constexpr const char* kThinDash = "1 3";

/// Okabe and Ito 2008, "Color Universal Design", without the yellow that white paper swallows.
constexpr std::array kColors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#000000", "#e69f00", "#56b4e9"};
constexpr std::array kDashes = {"", "7 3", "2 3", "9 3 2 3"};

std::string number(double value) {
    std::string text = std::to_string(std::round(value * 100) / 100);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text == "-0" ? "0" : text;
}

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '&': result += "&amp;"; break;
            case '<': result += "&lt;"; break;
            case '>': result += "&gt;"; break;
            case '"': result += "&quot;"; break;
            default: result += c;
        }
    }
    return result;
}

/// The document's extents.
struct Extents {
    double width = 0, height = 0;
    double right() const { return kLeft + kInnerWidth; }
    double bottom() const { return height - kBottom; }
};

/// Letters, not bytes.
size_t length(const std::string& text) {
    return size_t(std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

Extents extents_of(const Plot& plot) {
    size_t rows = 0, longest = 0;
    for (const PlotSeries& series : plot.series) {
        if (series.name.empty()) continue;
        ++rows;
        longest = std::max(longest, length(series.name));
    }
    return {kLeft + kInnerWidth + std::max(kLeastRight, kLegendGlyph + kLetter * double(longest)),
            std::max(kLeastHeight, kTop + kLegendRow * (double(rows) + 1))};
}

/// From values to the page.
class Scale {
  public:
    Scale(const PlotAxis& axis, std::vector<double> ticks, double from, double to)
        : logarithmic_(axis.logarithmic), ticks_(std::move(ticks)), from_(from), to_(to) {}

    const std::vector<double>& ticks() const { return ticks_; }
    bool shows(double value) const { return std::isfinite(value) && (!logarithmic_ || value > 0); }
    double at(double value) const {
        const double least = measure(ticks_.front()), most = measure(ticks_.back());
        return from_ + (to_ - from_) * (measure(value) - least) / (most - least);
    }

  private:
    double measure(double value) const { return logarithmic_ ? std::log10(value) : value; }

    bool logarithmic_;
    std::vector<double> ticks_;
    double from_, to_;
};

Scale scale_of(const Plot& plot, const PlotAxis& axis, double PlotPoint::*member, double from, double to) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const PlotSeries& series : plot.series)
        for (const PlotPoint& point : series.points) {
            const double value = point.*member;
            if (!std::isfinite(value) || (axis.logarithmic && !(value > 0))) continue;
            least = std::min(least, value);
            most = std::max(most, value);
        }
    if (least > most) least = most = 1;
    return {axis, axis_ticks(least, most, axis.logarithmic), from, to};
}

std::string line(double x1, double y1, double x2, double y2, const char* color) {
    return "<path d=\"M" + number(x1) + " " + number(y1) + "L" + number(x2) + " " + number(y2) + "\" stroke=\"" + color + "\"/>\n";
}

std::string text_at(double x, double y, const char* anchor, const std::string& text, const std::string& more = "") {
    return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" text-anchor=\"" + anchor + "\"" + more + ">" + escaped(text) +
           "</text>\n";
}

std::string axes(const Plot& plot, const Extents& extents, const Scale& x, const Scale& y) {
    const double left = kLeft, right = extents.right(), top = kTop, bottom = extents.bottom();
    std::string svg;
    for (const double tick : x.ticks()) {
        svg += line(x.at(tick), top, x.at(tick), bottom, "#ddd");
        svg += text_at(x.at(tick), bottom + 18, "middle", print_number(float(tick)));
    }
    for (const double tick : y.ticks()) {
        svg += line(left, y.at(tick), right, y.at(tick), "#ddd");
        svg += text_at(left - 8, y.at(tick) + 4, "end", print_number(float(tick)));
    }
    svg += line(left, bottom, right, bottom, "#333") + line(left, top, left, bottom, "#333");
    svg += text_at((left + right) / 2, extents.height - 14, "middle", plot.x.label);
    const double middle = (top + bottom) / 2;
    svg += text_at(16, middle, "middle", plot.y.label, " transform=\"rotate(-90 16 " + number(middle) + ")\"");
    return svg + text_at((left + right) / 2, 22, "middle", plot.title, " font-weight=\"bold\"");
}

const char* color_of(const PlotSeries& series, size_t index) {
    if (series.color == kGrey) return "#777777";
    return kColors[(series.color < 0 ? index : size_t(series.color)) % kColors.size()];
}

std::string stroke_of(const PlotSeries& series, size_t index) {
    const std::string dash = series.thin ? kThinDash : kDashes[(series.dash < 0 ? index : size_t(series.dash)) % kDashes.size()];
    return std::string("stroke=\"") + color_of(series, index) + "\" stroke-width=\"" + (series.thin ? "1" : "1.8") + "\"" +
           (dash.empty() ? "" : " stroke-dasharray=\"" + dash + "\"");
}

std::string marker(const PlotPoint& point, double x, double y, const char* color) {
    const auto circle = [&](const char* radius, const std::string& more) {
        return "<circle cx=\"" + number(x) + "\" cy=\"" + number(y) + "\" r=\"" + radius + "\" " + more;
    };
    std::string svg = point.ringed ? circle("7", std::string("stroke=\"") + color + "\" stroke-width=\"1.5\"/>\n") : "";
    const std::string fill = std::string("fill=\"") + (point.hollow ? "#fff" : color) + "\"" +
                             (point.hollow ? std::string(" stroke=\"") + color + "\" stroke-width=\"1.2\"" : "");
    svg += circle("3", fill + (point.key >= 0 ? " data-key=\"" + std::to_string(point.key) + "\"" : ""));
    return svg + (point.note.empty() ? "/>\n" : "><title>" + escaped(point.note) + "</title></circle>\n");
}

std::string curve(const PlotSeries& series, size_t index, const Scale& x, const Scale& y) {
    std::string path, markers;
    bool joined = false;
    for (const PlotPoint& point : series.points) {
        const bool shown = x.shows(point.x) && y.shows(point.y);
        if (shown) {
            path += (joined ? "L" : "M") + number(x.at(point.x)) + " " + number(y.at(point.y));
            if (series.markers) markers += marker(point, x.at(point.x), y.at(point.y), color_of(series, index));
        }
        joined = shown;
    }
    return path.empty() ? "" : "<path d=\"" + path + "\" " + stroke_of(series, index) + "/>\n" + markers;
}

std::string legend(const Plot& plot, const Extents& extents) {
    std::string svg;
    const double left = extents.right() + 14;
    double y = kTop + 10;
    for (size_t i = 0; i < plot.series.size(); ++i) {
        const PlotSeries& series = plot.series[i];
        if (series.name.empty()) continue;
        svg += "<path d=\"M" + number(left) + " " + number(y) + "h24\" " + stroke_of(series, i) + "/>\n";
        svg += text_at(left + 30, y + 4, "start", series.name);
        y += kLegendRow;
    }
    return svg;
}

/// 1, 2 or 5 times a power of ten, the least from `least` on.
double round_step(double least) {
    const double power = std::pow(10.0, std::floor(std::log10(least)));
    for (const double digit : {1.0, 2.0, 5.0})
        if (digit * power >= least * (1 - 1e-9)) return digit * power;
    return 10 * power;
}

std::vector<double> linear_ticks(double least, double most) {
    if (most - least <= 1e-12 * std::max(std::abs(least), std::abs(most))) {
        const double half = most == 0 ? 1 : std::abs(most) / 2;
        least -= half, most += half;
    }
    const double step = round_step((most - least) / 8);
    const auto first = int64_t(std::floor(least / step + 1e-9)), last = int64_t(std::ceil(most / step - 1e-9));
    std::vector<double> ticks;
    for (int64_t k = first; k <= last; ++k) ticks.push_back(double(k) * step);
    return ticks;
}

std::vector<double> logarithmic_ticks(double least, double most) {
    std::vector<double> ticks;
    const int first = int(std::floor(std::log10(least) + 1e-9));
    int last = int(std::ceil(std::log10(most) - 1e-9));
    if (last == first) ++last;
    const bool few = last - first <= 3;
    const int step = std::max(1, (last - first) / 8);
    for (int power = first; power < last; power += step)
        for (const double digit : {1.0, 2.0, 5.0})
            if (digit == 1.0 || few) ticks.push_back(digit * std::pow(10.0, power));
    ticks.push_back(std::pow(10.0, first + (last - first + step - 1) / step * step));
    // Between powers only those are kept that the values need.
    while (few && ticks.size() > 2 && ticks[1] <= least) ticks.erase(ticks.begin());
    while (few && ticks.size() > 2 && ticks[ticks.size() - 2] >= most) ticks.pop_back();
    return ticks;
}

}  // namespace

std::vector<double> axis_ticks(double least, double most, bool logarithmic) {
    return logarithmic ? logarithmic_ticks(least, most) : linear_ticks(least, most);
}

std::string plot_svg(const Plot& plot) {
    const Extents extents = extents_of(plot);
    const Scale x = scale_of(plot, plot.x, &PlotPoint::x, kLeft, extents.right());
    const Scale y = scale_of(plot, plot.y, &PlotPoint::y, extents.bottom(), kTop);
    std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + number(extents.width) + " " + number(extents.height) +
                      "\" font-family=\"sans-serif\" font-size=\"12\" fill=\"#222\">\n<title>" + escaped(plot.title) +
                      "</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n" + axes(plot, extents, x, y) +
                      "<g fill=\"none\">\n";
    for (size_t i = 0; i < plot.series.size(); ++i) svg += curve(plot.series[i], i, x, y);
    return svg + "</g>\n" + legend(plot, extents) + "</svg>\n";
}

}  // namespace rawtexel::cli
