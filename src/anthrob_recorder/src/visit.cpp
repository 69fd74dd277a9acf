#include "visit.h"

#include <cstdio>

namespace anthrob {

namespace {

std::string seconds_text(double seconds) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.1f s", seconds);
  return text;
}

std::string degrees_text(double angle) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.2f degrees", angle * 57.29577951308232);
  return text;
}

}  // namespace

int Visit::recordings(const Protocol& protocol) {
  return protocol.kind == Protocol::Kind::kTrajectories ? 2 : 1;
}

std::vector<Visit::Step> Visit::steps_of(const Protocol& protocol) {
  const Aim rest = Aim::kRest, there = Aim::kTarget;
  switch (protocol.kind) {
    case Protocol::Kind::kTrajectories:
      return {{"to the rest posture", rest, 0, End::kSettled, kNone},
              {"lead", rest, 1, End::kElapsed, kBefore},
              {"to the posture", there, 1, End::kSettled, kNone},
              {"hold", there, 1, End::kElapsed, kTarget},
              {"lead", there, 2, End::kElapsed, kNone},
              {"back to the rest posture", rest, 2, End::kSettled, kNone},
              {"hold", rest, 2, End::kElapsed, kAfter}};
    case Protocol::Kind::kZeroGravity:
      if (protocol.by_hand) {
        return {{"by hand", Aim::kRelease, 0, End::kTrigger, kNone},
                {"set by hand", Aim::kRelease, 1, End::kSettled, kNone},
                {"hold", Aim::kRelease, 1, End::kElapsed, kTarget}};
      }
      return {{"to the rest posture", rest, 0, End::kSettled, kNone},
              {"hold", rest, 0, End::kElapsed, kBefore},
              {"to the posture", there, 0, End::kSettled, kNone},
              {"in zero gravity", Aim::kRelease, 1, End::kSettled, kNone},
              {"hold", Aim::kRelease, 1, End::kElapsed, kTarget},
              {"back to the rest posture", rest, 0, End::kSettled, kNone},
              {"hold", rest, 0, End::kElapsed, kAfter}};
    case Protocol::Kind::kEquilibria:
      break;
  }
  return {{"to the rest posture", rest, 0, End::kSettled, kNone},
          {"lead", rest, 1, End::kElapsed, kBefore},
          {"to the posture", there, 1, End::kSettled, kNone},
          {"hold", there, 1, End::kElapsed, kTarget},
          {"back to the rest posture", rest, 0, End::kSettled, kNone},
          {"hold", rest, 0, End::kElapsed, kAfter}};
}

Visit::Visit(std::shared_ptr<const RobotModel> model, const Protocol& protocol,
             const Sample* baseline)
    : model_(model),
      protocol_(protocol),
      steps_(steps_of(protocol)),
      settle_(model, protocol.settle),
      mean_(model) {
  if (baseline) baseline_ = *baseline;
}

bool Visit::trigger() {
  const bool waited_for =
      outcome_ == Outcome::kRunning && begun_ && steps_[at_].end == End::kTrigger;
  triggered_ = triggered_ || waited_for;
  return waited_for;
}

void Visit::fail(const std::string& reason) {
  if (outcome_ != Outcome::kRunning) return;
  outcome_ = Outcome::kFailed;
  reason_ = reason;
}

double Visit::duration_of(Aim aim) const {
  const bool goes = protocol_.kind == Protocol::Kind::kZeroGravity && aim != Aim::kRelease;
  return goes ? protocol_.go_duration : 0.0;
}

void Visit::begin(double time) {
  begun_ = true;
  triggered_ = false;
  start_ = time;
  settle_.start(time);
  mean_.reset();
}

Visit::Order Visit::step(const RobotMeasurement& measured, double time) {
  if (outcome_ != Outcome::kRunning) return {Aim::kRest, 0};
  if (!begun_) begin(time);
  const Step& now = steps_[at_];
  const double elapsed = time - start_;
  bool over = false;
  switch (now.end) {
    case End::kSettled:
      // An arm that starts slowly seems to stand still.
      over = elapsed >= duration_of(now.aim) && settle_.step(measured, time);
      if (!over && elapsed > duration_of(now.aim) + protocol_.settle.timeout)
        fail(std::string(now.name) + ": not settled after " + seconds_text(elapsed));
      break;
    case End::kElapsed:
      over = elapsed >= protocol_.hold;
      if (elapsed >= protocol_.hold - protocol_.average || over) mean_.add(measured);
      break;
    case End::kTrigger:
      over = triggered_;
      break;
  }
  if (over) finish_step(time);
  if (outcome_ != Outcome::kRunning) return {Aim::kRest, 0};
  return {steps_[at_].aim, steps_[at_].recording};
}

void Visit::finish_step(double time) {
  const Step& over = steps_[at_];
  if (over.end == End::kSettled && over.recording == 1) settling_time_ = time - start_;
  if (over.sample != kNone) {
    samples_[over.sample] = mean_.mean(time);
    if (over.sample != kTarget) check_drift(samples_[over.sample]);
    if (outcome_ != Outcome::kRunning) return;
  }
  begun_ = false;
  if (++at_ == steps_.size()) {
    outcome_ = Outcome::kDone;
  } else {
    begin(time);
  }
}

void Visit::check_drift(const Sample& rest) {
  if (baseline_.position.empty()) {
    baseline_ = rest;
    return;
  }
  std::string joint;
  const double difference = largest_difference(*model_, baseline_, rest, joint);
  drift_ = std::max(drift_, difference);
  if (difference <= protocol_.drift_limit) return;
  outcome_ = Outcome::kDrifted;
  reason_ = "the rest posture has drifted by " + degrees_text(difference) + " at joint " + joint +
            ", more than the limit of " + degrees_text(protocol_.drift_limit);
}

}  // namespace anthrob
