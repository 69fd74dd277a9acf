#include "identification/ring_recording.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "anthrob_core/errors.h"
#include "anthrob_core/text.h"
#include "identification/number_text.h"
#include "identification/rig_recording.h"

namespace anthrob {
namespace identification {

namespace {

/// Share of the target strain from which on the ring counts as held.
constexpr double kReached = 0.95;
/// Share of a recovery, its last, in which the force sensor shows its offset.
constexpr double kQuiet = 0.25;
/// Of a recovery every so many samples are kept, but all just before the stretch.
constexpr std::size_t kThinning = 50, kKept = 250;

/// A stretch of rows with one reference.
struct Phase {
  std::size_t begin, end;
  double reference;
};

std::vector<Phase> phases_of(const std::vector<double>& reference) {
  std::vector<Phase> phases;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    if (i == 0 || reference[i] != reference[i - 1]) phases.push_back({i, i, reference[i]});
    phases.back().end = i + 1;
  }
  return phases;
}

struct Protocol {
  double hold, recover;
};

class Reader {
 public:
  explicit Reader(const Dataset& recording)
      : data_(recording),
        columns_(read_columns(recording, "ring stretcher",
                              {"ring/position", "ring/reference", "ring/force"})) {}

  RingRecording read() {
    result_.name = recording_name(data_);
    result_.period = columns_.period();
    read_meta();
    const auto phases = phases_of(columns_.values[1]);
    double released = phases.front().reference;
    for (const Phase& phase : phases) released = std::min(released, phase.reference);
    for (std::size_t i = 0; i < phases.size(); ++i) check_phase(phases, i, released);
    find_offset(phases, released);
    for (std::size_t i = 1; i < phases.size(); ++i) {
      if (phases[i].reference > released) add_test(phases[i - 1], phases[i]);
    }
    if (result_.tests.empty()) {
      throw BadInput(result_.name + ": no relaxation test: ring/reference never changes");
    }
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(std::size_t row, const std::string& message) const {
    char time[32];
    std::snprintf(time, sizeof(time), "%.3f", columns_.t[row]);
    throw BadInput(result_.name + ": at t = " + time + " s: " + message);
  }

  void read_meta() {
    const ConfigNode meta = rig_meta(data_);
    const ConfigNode specimen = meta.at("specimen"), rig = meta.at("rig"),
                     protocol = meta.at("protocol");
    RingSpecimen& ring = result_.specimen;
    ring.ring = specimen.text("ring");
    if (ring.ring.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                    "0123456789_-") != std::string::npos) {
      specimen.at("ring").fail_expected("letters, digits, _ and -, for it names files and springs");
    }
    ring.number = specimen.at("number").as_integer(1, 1000000);
    ring.rest_length = specimen.number("rest_length", Bounds::positive(), "m");
    ring.section_diameter = specimen.number("section_diameter", Bounds::positive(), "m");
    ring.strands = specimen.at("strands").as_integer(1, 100);
    result_.run = meta.at("run").as_integer(1, 1000000);
    radius_ = rig.number("effective_radius", Bounds::positive(), "m");
    start_length_ = rig.number("start_length", Bounds::positive(), "m");
    result_.scale_sigma = rig.number_or("scale_sigma", 0.0, Bounds::between(0.0, 1.0), "1");
    if (rig.has("force_average"))
      result_.force_average = rig.at("force_average").as_integer(1, 10000);
    protocol_ = {protocol.number("hold", Bounds::positive(), "s"),
                 protocol.number("recover", Bounds::positive(), "s")};
    for (const ConfigNode& part : {specimen, rig, protocol}) part.refuse_unknown_keys();
  }

  double duration(const Phase& phase) const {
    return columns_.t[phase.end - 1] - columns_.t[phase.begin] + result_.period;
  }

  /// Stretches and recoveries must take turns, each for its time.
  void check_phase(const std::vector<Phase>& phases, std::size_t i, double released) const {
    const Phase& phase = phases[i];
    const bool stretched = phase.reference > released;
    if (stretched && i == 0) {
      fail(phase.begin, "starts stretched: expected the ring released before the first test");
    }
    if (stretched && phases[i - 1].reference > released) {
      fail(phase.begin, "a stretch follows a stretch: expected the ring released in between");
    }
    const double due = stretched ? protocol_.hold : protocol_.recover;
    // The first release may be shorter, the last may be missing: nothing was before, or comes
    // after.
    if ((i == 0 || i + 1 == phases.size()) && !stretched) return;
    if (duration(phase) < kReached * due) {
      char text[96];
      std::snprintf(text, sizeof(text), "%s lasts %.2f s: expected %g s; is the recording cut off?",
                    stretched ? "this test" : "this recovery", duration(phase), due);
      fail(phase.begin, text);
    }
  }

  void find_offset(const std::vector<Phase>& phases, double released) {
    double sum = 0.0;
    std::size_t count = 0;
    for (const Phase& phase : phases) {
      if (phase.reference > released) continue;
      const auto length = static_cast<double>(phase.end - phase.begin);
      for (auto i = phase.end - static_cast<std::size_t>(std::ceil(kQuiet * length)); i < phase.end;
           ++i, ++count) {
        sum += columns_.values[2][i];
      }
    }
    result_.force_offset = sum / static_cast<double>(count);
  }

  void add_test(const Phase& recovery, const Phase& stretch) {
    RelaxationTest test;
    const double l0 = result_.specimen.rest_length;
    const std::size_t dense = static_cast<std::size_t>(result_.force_average) + kKept;
    std::size_t start = 0;
    for (std::size_t i = recovery.begin; i < stretch.end; ++i) {
      if (i + dense < stretch.begin && (i - recovery.begin) % kThinning != 0) continue;
      if (i == stretch.begin) start = test.t.size();
      test.t.push_back(columns_.t[i] - columns_.t[stretch.begin]);
      test.expansion.push_back(start_length_ - l0 + radius_ * columns_.values[0][i]);
      test.force.push_back(columns_.values[2][i] - result_.force_offset);
    }
    const std::size_t size = test.t.size();
    const std::size_t half = start + (size - start) / 2;
    const double held = std::accumulate(test.expansion.begin() + static_cast<std::ptrdiff_t>(half),
                                        test.expansion.end(), 0.0) /
                        static_cast<double>(size - half);
    if (!(held > 0.0)) {
      fail(stretch.begin, "the ring is not stretched although ring/reference increased");
    }
    for (test.hold = start; test.expansion[test.hold] < kReached * held;) ++test.hold;
    test.strain = held / l0;
    test.used = test.strain > kEllipseStrain;
    const double force = std::accumulate(test.force.begin() + static_cast<std::ptrdiff_t>(half),
                                         test.force.end(), 0.0) /
                         static_cast<double>(size - half);
    if (test.used && !(force > 0.0)) {  // else noise may hide it
      fail(stretch.begin, "ring/force: " + significant(force, 3) +
                              " N more while stretched than released: expected a positive "
                              "number; reverse the sign of the column");
    }
    result_.tests.push_back(std::move(test));
  }

  const Dataset& data_;
  RigColumns columns_;
  RingRecording result_;
  Protocol protocol_{};
  double radius_ = 0.0, start_length_ = 0.0;
};

}  // namespace

double RingSpecimen::area() const {
  return strands * 0.25 * M_PI * section_diameter * section_diameter;
}

RingRecording RingRecording::read(const Dataset& recording) {
  return Reader(recording).read();
}

}  // namespace identification
}  // namespace anthrob
