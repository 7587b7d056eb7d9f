#include "cli/progress.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace rawtexel::cli {
namespace {

constexpr double kQuietSeconds = 1.0;  // Auto says nothing before
constexpr double kRedrawSeconds = 0.1;
constexpr double kLineSeconds = 1.0;  // Auto's lines are no closer
constexpr int kBarWidth = 30;         // characters
constexpr const char* kEraseLine = "\r\033[K";

}  // namespace

std::string_view to_string(ProgressMode mode) {
    switch (mode) {
        case ProgressMode::Auto: return "auto";
        case ProgressMode::Always: return "always";
        case ProgressMode::Never: return "never";
    }
    return "";
}

ProgressReport::ProgressReport(std::ostream& out, ProgressMode mode, bool terminal, double samples, Clock clock)
    : out_(out), mode_(mode), terminal_(terminal), samples_(samples), clock_(std::move(clock)), start_(clock_()) {
    last_drawn_ = start_ - kLineSeconds;
}

ProgressReport::~ProgressReport() {
    // A run that failed still leaves a clean line for the error.
    if (bar_shown_) out_ << kEraseLine << std::flush;
}

void ProgressReport::update(double share) {
    if (mode_ == ProgressMode::Never) return;
    // Whoever finds the report busy goes on rendering; the next update is never far.
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock || finished_ || share < share_) return;
    share_ = std::min(share, 1.0);
    const double elapsed = clock_() - start_;
    if (mode_ == ProgressMode::Auto && elapsed < kQuietSeconds) return;
    if (terminal_)
        draw_bar(share_, elapsed);
    else
        print_line(share_, elapsed);
}

void ProgressReport::finish() {
    const std::lock_guard lock(mutex_);
    if (finished_) return;
    finished_ = true;
    if (bar_shown_) out_ << kEraseLine << std::flush;
    bar_shown_ = false;
    const bool announce = mode_ == ProgressMode::Always || lines_shown_;
    if (announce && last_tenth_ < 10) print_line(1.0, clock_() - start_);
}

void ProgressReport::draw_bar(double share, double elapsed) {
    const double now = start_ + elapsed;
    if (now - last_drawn_ < kRedrawSeconds) return;
    last_drawn_ = now;
    const int filled = int(share * kBarWidth);
    out_ << kEraseLine << '[' << std::string(size_t(filled), '#') << std::string(size_t(kBarWidth - filled), '.') << "] "
         << int(share * 100.0) << " %";
    if (elapsed > 0.0 && share > 0.0)
        out_ << "  " << print_quantity(samples_ * share / elapsed) << "samples/s  " << print_duration(elapsed * (1.0 - share) / share)
             << " left";
    out_ << std::flush;
    bar_shown_ = true;
}

void ProgressReport::print_line(double share, double elapsed) {
    const int tenth = int(share * 10.0 + 1e-9);
    const double now = start_ + elapsed;
    const bool too_soon = mode_ == ProgressMode::Auto && share < 1.0 && now - last_drawn_ < kLineSeconds;
    if (tenth <= last_tenth_ || too_soon) return;
    last_tenth_ = tenth;
    last_drawn_ = now;
    lines_shown_ = true;
    out_ << "rawtexel: " << tenth * 10 << " % after " << print_duration(elapsed) << '\n' << std::flush;
}

double ProgressReport::steady_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string print_duration(double seconds) {
    const int64_t whole = int64_t(std::llround(std::clamp(seconds, 0.0, 359999.0)));  // 99:59:59
    std::array<char, 32> text;
    if (whole >= 3600)
        std::snprintf(text.data(), text.size(), "%d:%02d:%02d", int(whole / 3600), int(whole / 60 % 60), int(whole % 60));
    else
        std::snprintf(text.data(), text.size(), "%d:%02d", int(whole / 60), int(whole % 60));
    return text.data();
}

std::string print_quantity(double value) {
    constexpr std::array<const char*, 5> kPrefixes{"", "k", "M", "G", "T"};
    size_t prefix = 0;
    while (value >= 999.5 && prefix + 1 < kPrefixes.size()) {
        value /= 1000.0;
        ++prefix;
    }
    const int decimals = value >= 99.95 ? 0 : value >= 9.995 ? 1 : 2;
    std::array<char, 48> text;
    std::snprintf(text.data(), text.size(), "%.*f %s", decimals, value, kPrefixes[prefix]);
    return text.data();
}

}  // namespace rawtexel::cli
