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
constexpr double kLineSeconds = 1.0;   // Auto's lines are no closer
constexpr double kLeftSeconds = 5.0;  // of a phase, until plain lines tell the time left
constexpr int kBarWidth = 30;          // characters
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

ProgressReport::ProgressReport(std::ostream& out, ProgressMode mode, bool terminal, Clock clock)
    : out_(out), mode_(mode), terminal_(terminal), clock_(std::move(clock)), start_(clock_()) {
    phase_start_ = start_;
    last_drawn_ = start_ - kLineSeconds;
}

ProgressReport::~ProgressReport() {
    // A run that failed still leaves a clean line for the error.
    erase_line();
}

bool ProgressReport::is_quiet(double now) const {
    return mode_ == ProgressMode::Never || (mode_ == ProgressMode::Auto && now - start_ < kQuietSeconds);
}

void ProgressReport::begin(std::string_view phase, double amount, std::string_view unit) {
    const std::lock_guard lock(mutex_);
    phase_ = phase;
    amount_ = amount;
    unit_ = unit;
    phase_start_ = clock_();
    share_ = 0.0;
    last_tenth_ = 0;
    if (is_quiet(phase_start_)) return;
    if (terminal_) {
        last_drawn_ = -kRedrawSeconds;
        draw_bar(phase_start_);
    } else if (mode_ == ProgressMode::Always) {
        out_ << "rawtexel: " << phase_ << '\n' << std::flush;
    }
}

void ProgressReport::update(double share) {
    if (mode_ == ProgressMode::Never) return;
    // Whoever finds the report busy goes on rendering; the next update is never far.
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock || finished_ || share < share_) return;
    share_ = std::min(share, 1.0);
    const double now = clock_();
    if (is_quiet(now)) return;
    if (terminal_)
        draw_bar(now);
    else
        print_line(share_, now);
}

void ProgressReport::finish() {
    const std::lock_guard lock(mutex_);
    if (finished_) return;
    finished_ = true;
    erase_line();
    if (!is_quiet(clock_()) && (!terminal_ || mode_ == ProgressMode::Always)) print_line(1.0, clock_());
}

void ProgressReport::clear() {
    const std::lock_guard lock(mutex_);
    erase_line();
}

void ProgressReport::draw_bar(double now) {
    if (now - last_drawn_ < kRedrawSeconds) return;
    last_drawn_ = now;
    bar_shown_ = true;
    out_ << kEraseLine;
    if (amount_ == 0.0) {
        out_ << phase_ << std::flush;
        return;
    }
    const int filled = int(share_ * kBarWidth);
    out_ << '[' << std::string(size_t(filled), '#') << std::string(size_t(kBarWidth - filled), '.') << "] " << int(share_ * 100.0) << " %";
    const double elapsed = now - phase_start_;
    if (elapsed > 0.0 && share_ > 0.0)
        out_ << "  " << print_quantity(amount_ * share_ / elapsed) << unit_ << "/s  " << print_duration(elapsed * (1.0 - share_) / share_)
             << " left";
    out_ << std::flush;
}

void ProgressReport::print_line(double share, double now) {
    const int tenth = int(share * 10.0 + 1e-9);
    const bool too_soon = mode_ == ProgressMode::Auto && share < 1.0 && now - last_drawn_ < kLineSeconds;
    // "100 %" alone says nothing.
    const bool alone = mode_ == ProgressMode::Auto && tenth == 10 && !lines_shown_;
    if (tenth <= last_tenth_ || too_soon || alone) return;
    last_tenth_ = tenth;
    last_drawn_ = now;
    lines_shown_ = true;
    const double elapsed = now - phase_start_;
    out_ << "rawtexel: " << tenth * 10 << " % after " << print_duration(elapsed);
    if (amount_ > 0.0 && tenth < 10 && elapsed >= kLeftSeconds) out_ << ", " << print_duration(elapsed * (1.0 - share) / share) << " left";
    out_ << '\n' << std::flush;
}

void ProgressReport::erase_line() {
    if (bar_shown_) out_ << kEraseLine << std::flush;
    bar_shown_ = false;
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
