#include "cli/progress.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <thread>
#include <vector>

namespace rawtexel::cli {
namespace {

/// A report whose clock the test moves.
struct Report {
    std::ostringstream out;
    double now = 100.0;
    ProgressReport progress;
    Report(ProgressMode mode, bool terminal) : progress(out, mode, terminal, [this] { return now; }) {}
    void run(int steps, double seconds) {
        progress.begin("rendering", 2e6);
        for (int i = 1; i <= steps; ++i) {
            now += seconds / steps;
            progress.update(double(i) / steps);
        }
        progress.finish();
    }
};

TEST(Progress, NeverIsSilent) {
    for (const bool terminal : {false, true}) {
        Report report(ProgressMode::Never, terminal);
        report.run(100, 60.0);
        EXPECT_EQ(report.out.str(), "");
    }
}

TEST(Progress, AutoIsSilentInAShortRun) {
    for (const bool terminal : {false, true}) {
        Report report(ProgressMode::Auto, terminal);
        report.run(100, 0.9);
        EXPECT_EQ(report.out.str(), "");
    }
}

TEST(Progress, PlainLinesComeEveryTenPercentAndNoOftener) {
    Report report(ProgressMode::Auto, false);
    report.run(1000, 100.0);
    const std::string text = report.out.str();
    EXPECT_EQ(std::ranges::count(text, '\n'), 10) << text;
    EXPECT_EQ(text.substr(0, text.find('\n')), "rawtexel: 10 % after 0:10, 1:30 left");
    EXPECT_TRUE(text.ends_with("rawtexel: 100 % after 1:40\n")) << text;
    EXPECT_EQ(text.find('\r'), std::string::npos);
}

TEST(Progress, AutoPrintsAtMostOneLineASecond) {
    Report report(ProgressMode::Auto, false);
    report.run(1000, 3.0);
    const auto lines = std::ranges::count(report.out.str(), '\n');
    EXPECT_GE(lines, 2) << report.out.str();
    EXPECT_LE(lines, 4) << report.out.str();
}

TEST(Progress, TheLastLineDoesNotStandAlone) {
    Report late(ProgressMode::Auto, false);
    late.run(1, 1.2);  // no share was known before the quiet second had passed
    EXPECT_EQ(late.out.str(), "");
    Report slow(ProgressMode::Auto, false);
    slow.run(2, 2.4);
    EXPECT_EQ(slow.out.str(), "rawtexel: 50 % after 0:01\nrawtexel: 100 % after 0:02\n");
}

TEST(Progress, AlwaysNamesEveryPhase) {
    for (const bool terminal : {false, true}) {
        Report report(ProgressMode::Always, terminal);
        report.progress.begin("loading");
        EXPECT_NE(report.out.str().find("loading"), std::string::npos);
        report.now += 30.0;
        report.run(10, 10.0);
        const std::string text = report.out.str();
        if (terminal) {
            EXPECT_NE(text.find("200 ksamples/s"), std::string::npos) << text;  // of the phase, not of the run
        } else {
            EXPECT_TRUE(text.starts_with("rawtexel: loading\nrawtexel: rendering\nrawtexel: 10 % after 0:01\n")) << text;
        }
    }
}

TEST(Progress, AutoNamesAPhaseThatBeginsLateOnATerminalOnly) {
    for (const bool terminal : {false, true}) {
        Report report(ProgressMode::Auto, terminal);
        report.progress.begin("loading");
        report.now += 5.0;
        report.progress.begin("preparing light");
        EXPECT_EQ(report.out.str(), terminal ? "\r\033[Kpreparing light" : "");
        report.progress.clear();
        EXPECT_EQ(report.out.str(), terminal ? "\r\033[Kpreparing light\r\033[K" : "");
    }
}

TEST(Progress, AlwaysSaysThatAShortRunEnded) {
    Report report(ProgressMode::Always, false);
    report.progress.finish();
    EXPECT_EQ(report.out.str(), "rawtexel: 100 % after 0:00\n");
}

TEST(Progress, ATerminalGetsABarWithRateAndTimeLeft) {
    Report report(ProgressMode::Auto, true);
    report.progress.begin("rendering", 2e6);
    report.now += 10.0;
    report.progress.update(0.25);
    const std::string text = report.out.str();
    EXPECT_NE(text.find("[#######......................."), std::string::npos) << text;
    EXPECT_NE(text.find("25 %"), std::string::npos) << text;
    EXPECT_NE(text.find("50.0 ksamples/s"), std::string::npos) << text;  // a quarter of two million in ten seconds
    EXPECT_NE(text.find("0:30 left"), std::string::npos) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos);
    report.progress.finish();
    EXPECT_TRUE(report.out.str().ends_with("\r\033[K"));
}

TEST(Progress, TheRateIsOfWhatThePhaseComputes) {
    Report report(ProgressMode::Auto, true);
    report.progress.begin("measuring", 4e6, "shaded texels");
    report.now += 10.0;
    report.progress.update(0.25);
    EXPECT_NE(report.out.str().find("100 kshaded texels/s"), std::string::npos) << report.out.str();
}

TEST(Progress, TheBarNeverGoesBack) {
    Report report(ProgressMode::Always, true);
    report.now += 1.0;
    report.progress.update(0.5);
    const std::string before = report.out.str();
    report.now += 1.0;
    report.progress.update(0.25);
    EXPECT_EQ(report.out.str(), before);
}

TEST(Progress, TheBarIsGoneWhenARunFails) {
    std::ostringstream out;
    double now = 0.0;
    {
        ProgressReport progress(out, ProgressMode::Always, true, [&] { return now; });
        progress.begin("rendering", 1.0);
        now = 1.0;
        progress.update(0.5);
        EXPECT_FALSE(out.str().ends_with("\r\033[K"));
    }
    EXPECT_TRUE(out.str().ends_with("\r\033[K"));
}

TEST(Progress, ManyThreadsReportOnceEach) {
    Report report(ProgressMode::Always, false);
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&] {
            for (int i = 1; i <= 1000; ++i) report.progress.update(i / 1000.0);
        });
    for (std::thread& thread : threads) thread.join();
    report.progress.finish();
    const std::string text = report.out.str();
    EXPECT_LE(std::ranges::count(text, '\n'), 10) << text;
    EXPECT_TRUE(text.ends_with("100 % after 0:00\n")) << text;
}

TEST(Progress, DurationsAndQuantitiesReadWell) {
    EXPECT_EQ(print_duration(0.4), "0:00");
    EXPECT_EQ(print_duration(59.6), "1:00");
    EXPECT_EQ(print_duration(3723.0), "1:02:03");
    EXPECT_EQ(print_duration(1e300), "99:59:59");
    EXPECT_EQ(print_quantity(0.0), "0.00 ");
    EXPECT_EQ(print_quantity(999.6), "1.00 k");
    EXPECT_EQ(print_quantity(12345678.0), "12.3 M");
}

}  // namespace
}  // namespace rawtexel::cli
