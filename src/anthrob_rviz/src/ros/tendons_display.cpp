#include "ros/tendons_display.h"

#include <OgreSceneNode.h>
#include <rviz/display_context.h>
#include <rviz/display_group.h>
#include <rviz/frame_manager.h>
#include <rviz/properties/color_property.h>
#include <rviz/properties/enum_property.h>
#include <rviz/properties/float_property.h>
#include <rviz/properties/ros_topic_property.h>
#include <rviz/properties/string_property.h>

#include "anthrob_core/monotonic_clock.h"
#include "display/fitted_camera.h"
#include "display/force_legend.h"
#include "ros/tendon_message.h"

namespace anthrob {

namespace {

enum ThemeOption { kOwn, kDark, kLight };

std::string next_legend_name() {
  static int count = 0;
  return "anthrob tendons' legend " + std::to_string(count++);
}

rviz::StatusProperty::Level to_rviz(Level level) {
  if (level == Level::kOk) return rviz::StatusProperty::Ok;
  return level == Level::kWarning ? rviz::StatusProperty::Warn : rviz::StatusProperty::Error;
}

}  // namespace

TendonsDisplay::TendonsDisplay()
    : topic_(new rviz::RosTopicProperty(
          "Topic", "tendon_paths",
          QString::fromStdString(ros::message_traits::datatype<anthrob_msgs::TendonPaths>()),
          "anthrob_msgs/TendonPaths of the simulator, or beside a robot of anthrob_tendons.",
          this)),
      thickness_(new rviz::FloatProperty("Thickness [mm]", 0.0f,
                                         "Of taut tendons; 0: as suits the robot's size. Slack "
                                         "ones are thinner.",
                                         this)),
      full_force_(new rviz::FloatProperty("Full colour [N]", static_cast<float>(kFullColourForce),
                                          "Force at which the scale of colours ends.", this)),
      theme_(
          new rviz::EnumProperty("Theme", "own",
                                 "Colours of background, legend and names; own: the background is "
                                 "that of the Global Options.",
                                 this)),
      names_(new rviz::BoolProperty("Names", false, "Write the muscles' names.", this)),
      legend_shown_(new rviz::BoolProperty("Legend", true, "Show what the colours mean.", this)),
      fit_view_(new rviz::BoolProperty(
          "Fit View", true,
          "Move the orbiting camera once, when the robot is there, so that all of it is seen.",
          this)),
      tf_prefix_(new rviz::StringProperty(
          "TF Prefix", "", "As of the display RobotModel: before the links' names in tf.", this)) {
  thickness_->setMin(0.0f);
  full_force_->setMin(0.001f);
  for (const auto& [name, option] :
       {std::pair("own", kOwn), std::pair("dark", kDark), std::pair("light", kLight)}) {
    theme_->addOption(name, option);
  }
  QObject::connect(theme_, &rviz::Property::changed, this, [this] { take_theme(); });
  QObject::connect(topic_, &rviz::Property::changed, this, [this] {
    if (isEnabled()) subscribe();
  });
}

TendonsDisplay::~TendonsDisplay() = default;

void TendonsDisplay::onInitialize() {
  legend_ = std::make_unique<ScreenOverlay>(next_legend_name());
  take_theme();
}

void TendonsDisplay::onEnable() {
  subscribe();
}

void TendonsDisplay::onDisable() {
  subscriber_.shutdown();
  reset();
}

void TendonsDisplay::reset() {
  rviz::Display::reset();
  tendons_.clear();
  visuals_.clear();
  heard_.reset();
  wrong_.reset();
  fitting_.reset();
  whole_.reset();
  view_fitted_ = false;
  if (legend_) legend_->hide();
  legend_force_.reset();
}

void TendonsDisplay::setTopic(const QString& topic, const QString& /*datatype*/) {
  topic_->setString(topic);
}

void TendonsDisplay::subscribe() {
  reset();
  subscriber_.shutdown();
  try {
    subscriber_ = update_nh_.subscribe(topic_->getTopicStd(), 2, &TendonsDisplay::hear, this);
  } catch (const ros::Exception& error) {
    wrong_ = error.what();
  }
}

void TendonsDisplay::hear(const anthrob_msgs::TendonPaths& message) {
  HeardTendons heard = tendons_of(message);
  heard_ = monotonic_now();
  wrong_ = heard.wrong;
  if (wrong_) return;
  tendons_ = std::move(heard.tendons);
  if (are_other_tendons()) take_visuals();
}

bool TendonsDisplay::are_other_tendons() const {
  if (tendons_.size() != visuals_.size()) return true;
  for (std::size_t i = 0; i < tendons_.size(); ++i) {
    if (tendons_[i].name != visuals_[i]->facts().name) return true;
  }
  return false;
}

void TendonsDisplay::take_visuals() {
  visuals_.clear();
  fitting_.reset();
  for (const Tendon& tendon : tendons_) {
    visuals_.push_back(std::make_unique<TendonVisual>(tendon.name, context_, scene_node_));
  }
}

TendonFeed TendonsDisplay::feed() const {
  TendonFeed feed;
  feed.topic = subscriber_ ? subscriber_.getTopic() : topic_->getTopicStd();
  feed.publishers = subscriber_ ? static_cast<int>(subscriber_.getNumPublishers()) : 0;
  if (heard_) feed.age = monotonic_now() - *heard_;
  feed.wrong = wrong_;
  feed.tendons = tendons_.size();
  return feed;
}

/// As RViz's robot model asks for its links: the answer is the same one throughout a frame.
std::optional<Pose> TendonsDisplay::pose_of(const std::string& link) const {
  const std::string prefix = tf_prefix_->getStdString();
  Ogre::Vector3 p;
  Ogre::Quaternion q;
  const bool known = context_->getFrameManager()->getTransform(
      prefix.empty() ? link : prefix + "/" + link, ros::Time(), p, q);
  if (!known) return std::nullopt;
  return Pose{Quat(q.w, q.x, q.y, q.z).normalized().toRotationMatrix(), Vec3(p.x, p.y, p.z)};
}

void TendonsDisplay::update(float /*wall_dt*/, float /*ros_dt*/) {
  const TendonFeed now = feed();
  show_status("Topic", feed_status(now));
  const PlacedTendons placed = place(tendons_, [this](const auto& link) { return pose_of(link); });
  if (!tendons_.empty()) show_status("Links", link_status(placed.links, placed.lost));
  draw(placed, now.is_old() || now.wrong);
  fit_view(placed);
  show_legend();
  context_->queueRender();
}

void TendonsDisplay::draw(const PlacedTendons& placed, bool old) {
  TendonStyle style;
  style.thickness = thickness(placed);
  style.full_force = static_cast<double>(full_force_->getFloat());
  style.names = names_->getBool();
  style.text = theme().text;
  for (std::size_t i = 0; i < visuals_.size(); ++i) {
    TendonFacts facts;
    facts.name = tendons_[i].name;
    facts.force = tendons_[i].force;
    facts.slack = tendons_[i].slack;
    facts.old = old;
    visuals_[i]->tell(facts);
    visuals_[i]->draw(placed.lines[i], style);
  }
}

double TendonsDisplay::thickness(const PlacedTendons& placed) {
  if (thickness_->getFloat() > 0.0f) return 1e-3 * static_cast<double>(thickness_->getFloat());
  // Once for a robot: it must not change with the posture.
  if (!fitting_ && placed.lost.empty() && !placed.lines.empty()) {
    fitting_ = fitting_thickness(placed.lines);
  }
  return fitting_.value_or(fitting_thickness(placed.lines));
}

/// RViz has loaded the meshes some frames after all links are known.
void TendonsDisplay::fit_view(const PlacedTendons& placed) {
  constexpr double kLoading = 1.0;  // [s]
  if (view_fitted_ || !fit_view_->getBool()) return;
  if (tendons_.empty() || !placed.lost.empty()) return whole_.reset();
  const double now = monotonic_now();
  if (!whole_) whole_ = now;
  if (now - *whole_ < kLoading) return;
  const auto box = robot_box(*context_, *scene_node_);
  if (!box) return;
  fit_camera(*context_, *box);
  view_fitted_ = true;
}

Theme TendonsDisplay::theme() const {
  return theme_->getOptionInt() == kLight ? light_theme() : dark_theme();
}

void TendonsDisplay::take_theme() {
  legend_force_.reset();  // is painted anew
  if (context_ == nullptr || theme_->getOptionInt() == kOwn) return;
  rviz::Property* options = context_->getRootDisplayGroup()->subProp("Global Options");
  options->subProp("Background Color")->setValue(theme().background);
}

void TendonsDisplay::show_legend() {
  if (!legend_shown_->getBool()) {
    legend_->hide();
    legend_force_.reset();
    return;
  }
  const double full = static_cast<double>(full_force_->getFloat());
  if (legend_force_ == full) return;
  legend_->show(force_legend(full, theme()));
  legend_force_ = full;
}

void TendonsDisplay::show_status(const char* name, const StatusLine& line) {
  setStatusStd(to_rviz(line.level), name, line.text);
}

}  // namespace anthrob
