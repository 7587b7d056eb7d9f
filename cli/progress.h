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

/// What a run is doing and how far it has come. Where `terminal`: one line redrawn in place, a bar with rate and time left for phases that
/// compute samples; it is gone from the screen when the report ends, by finish() or with the object. Elsewhere plain lines: the name of
/// each phase, and then one every ten percent (Auto: at most one a second, and the last only after another).
class ProgressReport {
  public:
    using Clock = std::function<double()>;  ///< seconds, never going back

    ProgressReport(std::ostream& out, ProgressMode mode, bool terminal, Clock clock = steady_seconds);
    ~ProgressReport();
    ProgressReport(const ProgressReport&) = delete;
    ProgressReport& operator=(const ProgressReport&) = delete;

    /// Begins the next phase, such as "loading". `amount`: how many `unit` it computes, for the rate; 0 where it computes none.
    void begin(std::string_view phase, double amount = 0.0, std::string_view unit = "samples");
    /// From any thread; `share` 0..1 of the phase. A share below one seen before changes nothing.
    void update(double share);
    void finish();
    /// Makes room for other words on a terminal; the next update draws the bar anew.
    void clear();

    static double steady_seconds();

  private:
    bool is_quiet(double now) const;
    void draw_bar(double now);
    void print_line(double share, double now);
    void erase_line();

    std::ostream& out_;
    const ProgressMode mode_;
    const bool terminal_;
    const Clock clock_;
    const double start_;
    std::mutex mutex_;  // guards what follows and the stream
    std::string phase_, unit_;
    double amount_ = 0.0, phase_start_ = 0.0;
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
