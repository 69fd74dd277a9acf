#include "display/tendon_visual.h"

#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <rviz/ogre_helpers/movable_text.h>

#include <cmath>

#include "tendon.h"

namespace anthrob {

namespace {

constexpr int kSides = 10;
constexpr double kSlackShare = 0.5;    ///< of the thickness
constexpr double kLetterHeight = 4.0;  ///< of the thickness

std::string unique_name(const std::string& muscle) {
  static int count = 0;
  return "anthrob tendon " + muscle + " " + std::to_string(count++);
}

}  // namespace

TendonVisual::TendonVisual(const std::string& name, rviz::DisplayContext* context,
                           Ogre::SceneNode* parent)
    : node_(parent->createChildSceneNode()),
      tube_(std::make_unique<TubeObject>(unique_name(name), node_)),
      selection_(context, facts_) {
  facts_.name = name;
}

TendonVisual::~TendonVisual() {
  label_.reset();
  tube_.reset();
  if (label_node_ != nullptr) node_->getCreator()->destroySceneNode(label_node_);
  node_->getCreator()->destroySceneNode(node_);
}

void TendonVisual::draw(const std::vector<Vec3>& line, const TendonStyle& style) {
  facts_.length = line_length(line);
  const double share = facts_.slack && !facts_.old ? kSlackShare : 1.0;
  const bool first = tube_->getSections().empty();
  tube_->show(tube(line, 0.5 * share * style.thickness, kSides));
  // RViz marks what can be selected by the parts that an object has by then.
  if (first && !tube_->getSections().empty()) selection_.addTrackedObject(tube_.get());
  const double unknown = std::nan("");
  tube_->paint(
      force_colour(facts_.old ? unknown : facts_.force.value_or(unknown), style.full_force));
  draw_name(line, style);
}

void TendonVisual::draw_name(const std::vector<Vec3>& line, const TendonStyle& style) {
  const bool shown = style.names && line.size() > 1;
  if (!label_ && shown) {
    label_ = std::make_unique<rviz::MovableText>(facts_.name);
    label_->setTextAlignment(rviz::MovableText::H_CENTER, rviz::MovableText::V_ABOVE);
    label_->showOnTop();
    label_node_ = node_->createChildSceneNode();
    label_node_->attachObject(label_.get());
  }
  if (!label_) return;
  label_->setVisible(shown);
  if (!shown) return;
  label_->setColor(Ogre::ColourValue(static_cast<float>(style.text.redF()),
                                     static_cast<float>(style.text.greenF()),
                                     static_cast<float>(style.text.blueF())));
  label_->setCharacterHeight(static_cast<float>(kLetterHeight * style.thickness));
  const Vec3 middle = middle_of(line);
  label_node_->setPosition(static_cast<float>(middle.x()), static_cast<float>(middle.y()),
                           static_cast<float>(middle.z()));
}

}  // namespace anthrob
