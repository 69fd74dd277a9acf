#include "anthrob_sim/muscle/muscle.h"

#include <algorithm>
#include <cmath>

#include "anthrob_core/errors.h"
#include "anthrob_ecu/gains.h"
#include "anthrob_sim/spring/series_elastic_element.h"
#include "core/delay_line.h"
#include "friction/sliding_tendon.h"
#include "muscle/motor_shaft.h"

namespace anthrob {

namespace {
enum SensorIndex { kPosition, kVelocity, kCurrent, kForce, kSensorCount };
}  // namespace

Muscle::Muscle(const MuscleModel& model, const SkeletonModel& skeleton, const SensorsModel& sensors,
               int index, double step, StateStore& store)
    : model_(model),
      controller_(model.controller),
      store_(store),
      step_(step),
      path_(*model.path),
      sliding_(std::make_unique<SlidingTendon>()) {
  const PathModel& path = *model.path;
  const SensorModel* kinds[] = {&sensors.position, &sensors.velocity, &sensors.current,
                                &sensors.force};
  actuator_offset_ = store.reserve(model.actuator->state_size());
  spring_offset_ = store.reserve(model.spring->state_size());
  path_offset_ = store.reserve(path.state_size());
  control_offset_ = store.reserve(state_size_of<Control>());
  tension_offset_ = store.reserve(path.segment_count());
  const int tick = model.has_controller ? model.steps_per_tick : sensors.steps_per_tick;
  for (int i = 0; i < kSensorCount; ++i) {
    sensors_.emplace_back(*kinds[i], sensors.seed,
                          static_cast<std::uint64_t>(index) * kSensorCount + i, step, tick);
    sensor_offsets_[i] = store.reserve(sensors_[i].state_size());
  }
  if (model.command_delay > 0.0) {
    command_delay_ = std::make_unique<DelayLine>(model.command_delay, 2, step);
    command_delay_offset_ = store.reserve(command_delay_->state_size());
  }

  if (model.is_drive()) {
    shaft_ = std::make_unique<MotorShaft>(*model.actuator, *model.transmission,
                                          skeleton.joints[path.joint()].velocity_offset, step);
  }
  const auto spring = static_cast<std::size_t>(model.spring_segment);
  path_before_spring_moves_ = false;
  for (std::size_t i = 0; i < spring; ++i) {
    path_before_spring_moves_ = path_before_spring_moves_ || !path.joints_of_segment(i).empty();
  }
  for (std::size_t i = spring + 1; i < path.segment_count(); ++i) {
    if (!path.obstacles()[i].friction) continue;
    sliding_obstacles_.push_back(i);
  }
  arms_.resize(skeleton.velocity_count, 0.0);
  if (sliding_obstacles_.empty()) return;
  for (std::size_t i = sliding_obstacles_.front(); i < path.segment_count(); ++i) {
    for (const JointOnPath& step_on_path : path.joints_of_segment(i)) {
      const JointModel& joint = skeleton.joints[step_on_path.joint];
      for (int k = 0; k < joint.dof(); ++k) sliding_->dofs.push_back(joint.velocity_offset + k);
    }
  }
  std::sort(sliding_->dofs.begin(), sliding_->dofs.end());
  sliding_->dofs.erase(std::unique(sliding_->dofs.begin(), sliding_->dofs.end()),
                       sliding_->dofs.end());
  const std::size_t count = sliding_obstacles_.size(), size = count * sliding_->dofs.size();
  sliding_->contacts.resize(count);
  sliding_->piece_arms.resize(size);
  sliding_->slide_arms.resize(size);
  for (auto* v : {&sliding_->tension_after, &sliding_->slide_speed, &sliding_->start_speed,
                  &sliding_->mu, &sliding_->slope, &sliding_->steepness}) {
    v->resize(count);
  }
}

Muscle::Muscle(Muscle&&) noexcept = default;
Muscle::~Muscle() = default;

StateView Muscle::contact_state(std::size_t i) const {
  const PathObstacle& obstacle = model_.path->obstacles()[i];
  const std::size_t own = obstacle.surface ? obstacle.surface->state_size() : 0;
  return path_state().from(model_.path->state_offset(i) + own);
}

void Muscle::place(const std::vector<BodyState>& bodies, double position) {
  for (std::size_t i = 0; i < model_.path->state_size(); ++i) path_state()[i] = 0.0;
  model_.actuator->place(position, actuator_state());
  path_.initialise(bodies, path_state());
  turn_along();
  relax();
}

void Muscle::turn_along() {
  if (!model_.is_drive() || std::isfinite(model_.transmission->stiffness)) return;
  const double play = 0.5 * model_.transmission->backlash;
  const double lag = std::clamp(expansion(), -play, play);
  const double position = model_.actuator->position_for(path_.length() - lag);
  model_.actuator->place(position, actuator_state());
}

void Muscle::follow(const std::vector<BodyState>& bodies) {
  path_.update(bodies, path_state());
  turn_along();
  relax();
}

void Muscle::relax() {
  Control& c = memory();
  c.expansion = expansion();
  c.expansion_rate = 0.0;
  c.friction_power = 0.0;
  c.sliding_power = 0.0;
  c.voltage = 0.0;
  c.controller = {};
  model_.spring->relax(c.expansion, spring_state());
  const double tension = model_.spring->relaxed_tension(c.expansion);
  for (std::size_t i = 0; i < model_.path->segment_count(); ++i) tension_slot(i) = tension;
  const double command[] = {c.mode, c.reference};
  if (command_delay_) command_delay_->fill(command, store_.at(command_delay_offset_));
}

void Muscle::command(ecu::Mode mode, double reference) {
  if (!std::isfinite(reference)) {
    throw BadInput("muscle " + model_.name + ": reference: expected a finite number");
  }
  if (mode != ecu::Mode::kVoltage && !model_.has_controller) {
    throw BadInput("muscle " + model_.name +
                   ": mode: expected VOLTAGE, because the muscle has no controller");
  }
  if (mode == ecu::Mode::kForce && !model_.has_force_sensor()) {
    throw BadInput("muscle " + model_.name +
                   ": mode: FORCE needs a force sensor, which the muscle lacks");
  }
  memory().mode = static_cast<double>(mode);
  memory().reference = reference;
}

void Muscle::set_gain(ecu::Parameter gain, double value) {
  if (!model_.has_controller) {
    throw BadInput("muscle " + model_.name +
                   ": expected a muscle with a controller; this one has no gains");
  }
  double* place = ecu::gain_of(controller_, gain);
  if (!place) throw BadInput("muscle " + model_.name + ": expected a parameter that is a gain");
  const ecu::ParameterInfo& info = *ecu::find_gain(ecu::name(gain));
  const Bounds range = Bounds::between(info.lowest, info.highest);
  if (!range.contains(value)) {
    throw BadInput("muscle " + model_.name + ": " + info.name + ": " + std::to_string(value) +
                   ": expected " + range.text() + " [" + info.unit + "]");
  }
  *place = value;
}

void Muscle::set_enabled(bool enabled) {
  memory().enabled = enabled ? 1.0 : 0.0;
  // At once, for it may be enabled again before the next tick.
  if (!enabled) forget();
}

void Muscle::forget() {
  memory().controller = {};
  const double nothing[] = {static_cast<double>(ecu::Mode::kVoltage), 0.0};
  if (command_delay_) command_delay_->fill(nothing, store_.at(command_delay_offset_));
}

void Muscle::apply_voltage(double voltage) {
  command(ecu::Mode::kVoltage, voltage);
  memory().drive = static_cast<double>(Drive::kVoltage);
}

void Muscle::impose(double position, double velocity) {
  Control& c = memory();
  c.drive = static_cast<double>(Drive::kImposed);
  c.imposed_position = position;
  c.imposed_velocity = velocity;
}

void Muscle::release() {
  memory().drive = static_cast<double>(Drive::kController);
}

ecu::Measurement Muscle::truth() const {
  const Actuator::Readout actuator = model_.actuator->read(actuator_state());
  return {actuator.position, actuator.velocity, actuator.current, force()};
}

void Muscle::reset_sensors(const ecu::Measurement& seen) {
  const double values[] = {seen.position, seen.velocity, seen.current, seen.force};
  for (int i = 0; i < kSensorCount; ++i)
    sensors_[i].reset(values[i], store_.at(sensor_offsets_[i]));
}

void Muscle::sense(std::uint64_t step_index, const ecu::Measurement& seen) {
  ecu::Measurement& m = memory().measured;
  const auto measure = [&](SensorIndex i, double value) {
    return sensors_[i].measure(value, step_index, store_.at(sensor_offsets_[i]));
  };
  m.position = measure(kPosition, seen.position);
  m.velocity = measure(kVelocity, seen.velocity);
  m.current = measure(kCurrent, seen.current);
  memory().force_reading = m.force = measure(kForce, seen.force);
  // As the ECU: a tendon does not push, below zero there are only noise and offset.
  if (!model_.is_drive()) m.force = std::max(m.force, 0.0);
}

void Muscle::control(std::uint64_t step_index) {
  Control& c = memory();
  ecu::Mode heard_mode = mode();
  double heard = c.reference;
  if (command_delay_) delay_command(heard_mode, heard);
  // What is applied past the control law does not wait for its tick either.
  const bool applied = drive() == Drive::kVoltage && c.enabled != 0.0;
  if (!applied && step_index % static_cast<std::uint64_t>(model_.steps_per_tick) != 0) return;
  if (c.enabled == 0.0) {
    c.voltage = 0.0;
  } else if (model_.has_controller) {
    ecu::Measurement seen = c.measured;
    if (!model_.has_force_sensor()) seen.force = 0.0;  // as the unit reads it then
    c.voltage = ecu::control(heard_mode, heard, seen, controller_, c.controller);
  } else {
    c.voltage = std::clamp(heard, model_.actuator->input_low(), model_.actuator->input_high());
  }
}

void Muscle::delay_command(ecu::Mode& mode, double& reference) {
  const StateView state = store_.at(command_delay_offset_);
  const double now[] = {static_cast<double>(mode), reference};
  // What stops forgets what is still on its way, too: enabling it never makes it jump.
  if (memory().enabled == 0.0) {
    forget();
  } else if (drive() == Drive::kVoltage) {
    command_delay_->fill(now, state);  // not on its way but there
  } else {
    command_delay_->push(now, state);
  }
  mode = static_cast<ecu::Mode>(static_cast<int>(command_delay_->nearest(0, state)));
  // Between a voltage and an angle there is nothing.
  reference = command_delay_->between_equals(0, state) ? command_delay_->blended(1, state)
                                                       : command_delay_->nearest(1, state);
}

void Muscle::prepare_drive(const KinematicTree& tree, double input) {
  if (!shaft_) return;
  const Control& c = memory();
  const int dof = shaft_->dof();
  const MotorShaft::Motion motion = {input, drive() == Drive::kImposed, c.imposed_position,
                                     c.imposed_velocity};
  shaft_->prepare(actuator_state(), motion, expansion(), tension(0), tree.mass_matrix()(dof, dof),
                  tree.velocities()[dof]);
}

DriveShaft* Muscle::shaft() {
  return shaft_.get();
}

void Muscle::prepare_sliding(const KinematicTree& tree, Eigen::VectorXd& tau) {
  if (shaft_) return;
  const std::size_t first =
      sliding_obstacles_.empty() ? model_.path->segment_count() : sliding_obstacles_.front();
  for (std::size_t i = 0; i < first; ++i) {
    // Slots beyond the spring still hold the step before.
    const double pull =
        i <= static_cast<std::size_t>(model_.spring_segment) ? tension(i) : spring_tension();
    path_.add_moment_arms(i, pull, tree, tau.data());
  }
  if (sliding_obstacles_.empty()) return;

  sliding_->tension = spring_tension();
  const std::size_t nd = sliding_->dofs.size(), count = sliding_obstacles_.size();
  for (std::size_t j = 0; j < count; ++j) {
    const std::size_t obstacle = sliding_obstacles_[j];
    const std::size_t end =
        j + 1 < count ? sliding_obstacles_[j + 1] : model_.path->segment_count();
    for (const int dof : sliding_->dofs) arms_[dof] = 0.0;
    for (std::size_t i = obstacle; i < end; ++i) path_.add_moment_arms(i, 1.0, tree, arms_.data());
    for (std::size_t a = 0; a < nd; ++a)
      sliding_->piece_arms[j * nd + a] = arms_[sliding_->dofs[a]];
    sliding_->contacts[j] = {model_.path->obstacles()[obstacle].friction.get(),
                             contact_state(obstacle), path_.obstacles()[obstacle].turning};
  }
  for (std::size_t a = 0; a < nd; ++a) {
    double sum = 0.0;
    for (std::size_t j = count; j-- > 0;) {
      sum += sliding_->piece_arms[j * nd + a];
      sliding_->slide_arms[j * nd + a] = sum;
    }
  }
}

void Muscle::finish_sliding() {
  if (shaft_) {
    tension_slot(0) = shaft_->torque();
    return;
  }
  double tension = spring_tension();
  std::size_t next = 0;
  for (std::size_t i = model_.spring_segment + 1; i < model_.path->segment_count(); ++i) {
    if (next < sliding_obstacles_.size() && sliding_obstacles_[next] == i) {
      tension = sliding_->tension_after[next++];
    }
    tension_slot(i) = tension;
  }
  memory().sliding_power = sliding_power();
}

void Muscle::advance_actuator(double input) {
  const Control& c = memory();
  if (drive() == Drive::kImposed) {
    model_.actuator->impose(c.imposed_position, c.imposed_velocity, tension(0), actuator_state());
  } else {
    model_.actuator->advance(input, tension(0), actuator_state());
  }
}

void Muscle::update(const std::vector<BodyState>& bodies, const KinematicTree& tree) {
  path_.update(bodies, path_state());
  Control& c = memory();
  const double stretched = expansion();
  c.expansion_rate = (stretched - c.expansion) / step_;
  c.expansion = stretched;
  const double tension = model_.spring->advance(stretched, spring_state());
  if (shaft_) return;  // its torque is of the motion within the step
  tension_slot(model_.spring_segment) = tension;
  update_tensions_before_spring(tree);
}

void Muscle::update_tensions_before_spring(const KinematicTree& tree) {
  const double winding = model_.actuator->winding_speed(actuator_state());
  double power = 0.0;
  for (int i = model_.spring_segment; i > 0; --i) {
    double tension = tension_slot(i);
    if (const FrictionLaw* law = model_.path->obstacles()[i].friction.get()) {
      // The tendon between actuator and this place gets longer if the path there does.
      const double speed = winding + (path_before_spring_moves_ ? path_rate(i, tree) : 0.0);
      const StateView state = contact_state(i);
      tension *= std::exp(law->coefficient(speed, state) * path_.obstacles()[i].turning);
      law->commit(speed, state);
      power += (tension - tension_slot(i)) * speed;
    }
    tension_slot(i - 1) = tension;
  }
  memory().friction_power = power;
}

double Muscle::path_rate(std::size_t end, const KinematicTree& tree) const {
  std::fill(arms_.begin(), arms_.end(), 0.0);
  for (std::size_t i = 0; i < end; ++i) path_.add_moment_arms(i, -1.0, tree, arms_.data());
  double rate = 0.0;
  for (std::size_t k = 0; k < arms_.size(); ++k) rate += arms_[k] * tree.velocities()[k];
  return rate;
}

double Muscle::tendon_length() const {
  return model_.actuator->tendon_length(actuator_state());
}

double Muscle::expansion() const {
  return path_.length() - tendon_length() - model_.spring->rest_length();
}

Actuator::Readout Muscle::actuator() const {
  return model_.actuator->read(actuator_state());
}
const ecu::Measurement& Muscle::measured() const {
  return memory().measured;
}

double Muscle::force_reading() const {
  return memory().force_reading;
}
ecu::Mode Muscle::mode() const {
  return static_cast<ecu::Mode>(static_cast<int>(memory().mode));
}
double Muscle::reference() const {
  return memory().reference;
}
bool Muscle::enabled() const {
  return memory().enabled != 0.0;
}
double Muscle::voltage() const {
  return memory().voltage;
}
double Muscle::tension(std::size_t segment) const {
  return tension_slot(segment);
}

double Muscle::friction_power() const {
  return memory().friction_power + memory().sliding_power;
}

/// As the solver left it: scratch memory, of no use after a restore.
double Muscle::sliding_power() const {
  double power = 0.0, before = sliding_->tension;
  for (std::size_t j = 0; j < sliding_->contacts.size(); ++j) {
    const double speed = 0.5 * (sliding_->start_speed[j] + sliding_->slide_speed[j]);
    power += (before - sliding_->tension_after[j]) * speed;
    before = sliding_->tension_after[j];
  }
  return power;
}

double Muscle::spring_energy() const {
  return model_.spring->stored_energy(spring_state());
}
double Muscle::spring_dissipation() const {
  return model_.spring->dissipation(memory().expansion_rate, spring_state());
}

}  // namespace anthrob
