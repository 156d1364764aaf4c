// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/shrink.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <tuple>

namespace fetexc::test {
namespace {

/// Bits of a coordinate above its lowest set one.
int significant_bits(std::int64_t v) {
    const auto u = static_cast<std::uint64_t>(std::abs(v));
    return u == 0 ? 0 : std::bit_width(u) - std::countr_zero(u);
}

/// Every step makes this smaller, so shrinking ends.
auto size_of(const Drawing& d) {
    std::size_t degrees = 0;
    long bits = 0, points = 0;
    std::vector<LatticePoint> places;
    for (const Path& path : d.paths) {
        for (const auto& curve : path) {
            degrees += curve.size() - 1;
            for (const LatticePoint p : curve)
                bits += significant_bits(p.x) + significant_bits(p.y), places.push_back(p);
        }
    }
    std::sort(places.begin(), places.end());
    points = std::unique(places.begin(), places.end()) - places.begin();
    return std::tuple(d.paths.size(), curve_count(d), degrees, bits, points, d.rule == FillRule::EvenOdd ? 1 : 0);
}

class Shrinker {
  public:
    Shrinker(Drawing drawing, const StillFails& still_fails) : best_(std::move(drawing)), still_fails_(still_fails) {}

    Drawing run() {
        for (bool smaller = true; smaller;) {
            const auto before = size_of(best_);
            remove_paths(), remove_curves(), lower_degrees();
            round_together(), round_points(), join_points();
            Drawing d = best_;
            d.rule = FillRule::NonZero;
            attempt(std::move(d));
            smaller = size_of(best_) < before;
        }
        return best_;
    }
    [[nodiscard]] ShrinkCounts counts() const { return counts_; }

  private:
    bool attempt(Drawing d) {
        if (!(size_of(d) < size_of(best_))) return false;
        ++counts_.tried;
        if (!still_fails_(d)) return false;
        ++counts_.kept;
        best_ = std::move(d);
        return true;
    }

    /// Halves, quarters, … of a list, from its end; list(drawing) gives the list.
    template <class List> void remove_from(const List& list) {
        for (std::size_t chunk = std::max<std::size_t>(1, list(best_).size() / 2);; chunk /= 2) {
            for (std::size_t end = list(best_).size(); end > 0;) {
                const std::size_t begin = end - std::min(chunk, end);
                Drawing d = best_;
                auto& items = list(d);
                items.erase(items.begin() + static_cast<std::ptrdiff_t>(begin),
                            items.begin() + static_cast<std::ptrdiff_t>(end));
                attempt(std::move(d));
                end = begin;
            }
            if (chunk == 1) return;
        }
    }

    void remove_paths() {
        remove_from([](Drawing& d) -> std::vector<Path>& { return d.paths; });
    }
    void remove_curves() {
        for (std::size_t k = 0; k < best_.paths.size(); ++k)
            remove_from([k](Drawing& d) -> Path& { return d.paths[k]; });
    }

    template <class Visit> void each_curve(const Visit& visit) {
        for (std::size_t k = 0; k < best_.paths.size(); ++k) {
            for (std::size_t i = 0; i < best_.paths[k].size(); ++i)
                visit(k, i);
        }
    }

    /// Leaves out one handle.
    void lower_degrees() {
        each_curve([&](std::size_t k, std::size_t i) {
            for (std::size_t h = 1; h + 1 < best_.paths[k][i].size(); ++h) {
                Drawing d = best_;
                auto& curve = d.paths[k][i];
                curve.erase(curve.begin() + static_cast<std::ptrdiff_t>(h));
                attempt(std::move(d));
            }
        });
    }

    static std::int64_t rounded(std::int64_t v, int bits) {
        const std::int64_t unit = std::int64_t{1} << bits;
        return (v + unit / 2) >> bits << bits;
    }

    void round_together() {
        for (int bits = 25; bits > 0; --bits) {
            if (attempt(mapped(best_, [bits](LatticePoint p) {
                    return LatticePoint{rounded(p.x, bits), rounded(p.y, bits)};
                })))
                return;
        }
    }

    /// Every place on its own: points at one place move together, then each coordinate of each point alone.
    void round_points() {
        each_curve([&](std::size_t k, std::size_t i) {
            for (std::size_t h = 0; h < best_.paths[k][i].size(); ++h) {
                const LatticePoint at = best_.paths[k][i][h];
                round_one(
                    [&](const LatticePoint& to) {
                        return mapped(best_, [&](LatticePoint p) { return p == at ? to : p; });
                    },
                    at);
                round_one(
                    [&](const LatticePoint& to) {
                        Drawing d = best_;
                        d.paths[k][i][h] = to;
                        return d;
                    },
                    best_.paths[k][i][h]);
            }
        });
    }

    template <class Moved> void round_one(const Moved& moved, LatticePoint at) {
        for (int bits = 26; bits > 0; --bits) {
            const LatticePoint x{rounded(at.x, bits), at.y};
            if (x != at && attempt(moved(x))) {
                at = x;
                break;
            }
        }
        for (int bits = 26; bits > 0; --bits) {
            const LatticePoint y{at.x, rounded(at.y, bits)};
            if (y != at && attempt(moved(y))) return;
        }
    }

    /// A point moves to its neighbour in the curve.
    void join_points() {
        each_curve([&](std::size_t k, std::size_t i) {
            for (std::size_t h = 1; h < best_.paths[k][i].size(); ++h) {
                for (const bool forward : {false, true}) {
                    Drawing d = best_;
                    auto& curve = d.paths[k][i];
                    (forward ? curve[h - 1] : curve[h]) = forward ? curve[h] : curve[h - 1];
                    attempt(std::move(d));
                }
            }
        });
    }

    Drawing best_;
    const StillFails& still_fails_;
    ShrinkCounts counts_;
};

void set_limit(decltype(RLIMIT_CPU) resource, rlim_t value) {
    const rlimit limit{value, value};
    setrlimit(resource, &limit);
}

[[noreturn]] void answer(const std::function<Failure()>& question, unsigned seconds, int out) {
    set_limit(RLIMIT_CORE, 0);
    const rlimit cpu{seconds, seconds + 5}; // SIGXCPU first
    setrlimit(RLIMIT_CPU, &cpu);
    std::signal(SIGXCPU, SIG_DFL), std::signal(SIGALRM, SIG_DFL);
    alarm(10 * seconds);
    const Failure failure = question();
    if (failure) [[maybe_unused]]
        const auto written = write(out, failure->data(), failure->size());
    _exit(failure ? 1 : 0);
}

Outcome outcome_of(int status, std::string message) {
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
    if (WIFEXITED(status) && WEXITSTATUS(status) == 1) return {Outcome::Kind::Fails, std::move(message)};
    if (WIFEXITED(status)) return {Outcome::Kind::Crashes, "exit " + std::to_string(WEXITSTATUS(status))};
    const int signal = WTERMSIG(status);
    if (signal == SIGXCPU || signal == SIGALRM) return {Outcome::Kind::Hangs, "time limit"};
    return {Outcome::Kind::Crashes, "signal " + std::to_string(signal)};
}

} // namespace

Drawing shrink(Drawing drawing, const StillFails& still_fails, ShrinkCounts* counts) {
    Shrinker shrinker(std::move(drawing), still_fails);
    Drawing out = shrinker.run();
    if (counts != nullptr) *counts = shrinker.counts();
    return out;
}

Outcome ask_in_child(const std::function<Failure()>& question, unsigned seconds) {
    int ends[2] = {};
    if (pipe(ends) != 0) return {Outcome::Kind::Crashes, "no pipe"};
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        answer(question, seconds, ends[1]);
    }
    close(ends[1]);
    std::string message;
    char buffer[256];
    for (ssize_t n = 0; child > 0 && (n = read(ends[0], buffer, sizeof buffer)) != 0;) {
        if (n > 0)
            message.append(buffer, static_cast<std::size_t>(n));
        else if (errno != EINTR)
            break;
    }
    close(ends[0]);
    int status = 0;
    if (child < 0 || waitpid(child, &status, 0) != child) return {Outcome::Kind::Crashes, "no child process"};
    return outcome_of(status, std::move(message));
}

} // namespace fetexc::test
