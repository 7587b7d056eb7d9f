// How far a long run has come.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <ostream>
#include <string>
#include <string_view>

namespace rawtexel::cli {

/// Auto shows nothing of a run that ends within a second; Always reports from the start; Never stays silent.
enum class ProgressMode { Auto, Always, Never };
std::string_view to_string(ProgressMode mode);  // auto always never

/// A bar with rate and time left, redrawn in place, where `terminal`; elsewhere a plain line every ten percent
/// (Auto: and at most one a second).
/// The bar is gone from the screen when the report ends, by finish() or with the object.
class ProgressReport {
  public:
    using Clock = std::function<double()>;  ///< seconds, never going back

    /// `samples`: what the whole run computes, for the rate.
    ProgressReport(std::ostream& out, ProgressMode mode, bool terminal, double samples, Clock clock = steady_seconds);
    ~ProgressReport();
    ProgressReport(const ProgressReport&) = delete;
    ProgressReport& operator=(const ProgressReport&) = delete;

    /// From any thread; `share` 0..1. A share below one seen before changes nothing.
    void update(double share);
    void finish();

    static double steady_seconds();

  private:
    void draw_bar(double share, double elapsed);
    void print_line(double share, double elapsed);

    std::ostream& out_;
    const ProgressMode mode_;
    const bool terminal_;
    const double samples_;
    const Clock clock_;
    const double start_;
    std::mutex mutex_;  // guards what follows and the stream
    double share_ = 0.0;
    double last_drawn_ = 0.0;  // seconds
    int last_tenth_ = 0;
    bool bar_shown_ = false, lines_shown_ = false, finished_ = false;
};

/// "1:02:03", "2:03" or "0:05".
std::string print_duration(double seconds);
/// "12.3 M", "1.50 k": three digits and a prefix.
std::string print_quantity(double value);

}  // namespace rawtexel::cli
