#include "anthrob_driver/robot_driver.h"

#include <utility>

#include "driver/implementation.h"

namespace anthrob {
namespace driver {

RobotDriver::RobotDriver(Hardware hardware, const Options& options, Bus& bus)
    : implementation_(std::make_unique<Implementation>(std::move(hardware), options, bus)) {}

RobotDriver::~RobotDriver() = default;

void RobotDriver::cycle(double now) {
  implementation_->cycle(now);
}

void RobotDriver::receive(const BusEvent& event, double now) {
  implementation_->receive(event, now);
}

bool RobotDriver::take_sample(Sample& sample) {
  return implementation_->take_sample(sample);
}

bool RobotDriver::take_analog(AnalogSample& sample) {
  return implementation_->take_analog(sample);
}

RobotDriver::Outcome RobotDriver::command(const std::vector<std::string>& names,
                                          const std::vector<std::uint8_t>& modes,
                                          const std::vector<double>& references, double now,
                                          double age, const std::string& sender) {
  return implementation_->command(names, modes, references, now, age, sender);
}

RobotDriver::Outcome RobotDriver::refuse(const std::string& reason) {
  return implementation_->refuse(reason);
}

RobotDriver::Outcome RobotDriver::start_enable(double now) {
  return implementation_->start_enable(now);
}

RobotDriver::Outcome RobotDriver::start_home(double now) {
  return implementation_->start_home(now);
}

RobotDriver::Outcome RobotDriver::start_gains(const std::vector<std::string>& names,
                                              const std::vector<std::string>& gains,
                                              const std::vector<double>& values, double now) {
  return implementation_->start_gains(names, gains, values, now);
}

RobotDriver::Outcome RobotDriver::disable() {
  return implementation_->disable();
}

RobotDriver::Outcome RobotDriver::emergency_stop() {
  return implementation_->emergency_stop();
}

void RobotDriver::stop_unreachable(Finding finding, const std::string& detail, double now) {
  implementation_->stop(stopping_rule(finding, NoticedBy::kNode), std::nullopt, now, detail);
}

RobotDriver::Outcome RobotDriver::clear_faults(double now) {
  return implementation_->clear_faults(now);
}

bool RobotDriver::clearing(double now) const {
  return implementation_->clearing(now);
}

std::optional<std::string> RobotDriver::not_cleared() const {
  return implementation_->not_cleared();
}

RobotDriver::Phase RobotDriver::phase() const {
  return implementation_->phase();
}

const RobotDriver::Outcome& RobotDriver::last_outcome() const {
  return implementation_->last_outcome();
}

const Home& RobotDriver::home() const {
  return implementation_->home();
}

const LiveGains& RobotDriver::gains() const {
  return implementation_->gains();
}

const Hardware& RobotDriver::hardware() const {
  return implementation_->hardware();
}

const ecu::Supervisor& RobotDriver::supervisor() const {
  return implementation_->supervisor();
}

const WindingTemperatureModel& RobotDriver::winding(std::size_t muscle) const {
  return implementation_->winding(muscle);
}

const EcuLink& RobotDriver::link(std::size_t ecu) const {
  return implementation_->link(ecu);
}

const Findings& RobotDriver::findings() const {
  return implementation_->findings();
}

const BusWatch& RobotDriver::bus_watch() const {
  return implementation_->bus_watch();
}

std::uint64_t RobotDriver::cycles() const {
  return implementation_->cycles();
}

std::uint64_t RobotDriver::halts() const {
  return implementation_->halts();
}

const StopLog& RobotDriver::stops() const {
  return implementation_->stops();
}

}  // namespace driver
}  // namespace anthrob
