#include "display/tendon_selection.h"

#include <rviz/properties/string_property.h>

#include <cstdio>

namespace anthrob {

namespace {

std::string with_unit(const char* format, double value) {
  char text[32];
  std::snprintf(text, sizeof(text), format, value);
  return text;
}

void tell(rviz::StringProperty* property, const std::string& text) {
  property->setStdString(text);
}

}  // namespace

std::string force_text(const TendonFacts& facts) {
  if (facts.old) return "unknown: no messages";
  return facts.force ? with_unit("%.1f N", *facts.force) : "not measured";
}

std::string slack_text(const TendonFacts& facts) {
  if (facts.old || (!facts.force && !facts.slack)) return "unknown";
  return facts.slack ? "yes" : "no";
}

std::string length_text(const TendonFacts& facts) {
  return with_unit("%.1f mm", 1e3 * facts.length);
}

TendonSelection::TendonSelection(rviz::DisplayContext* context, const TendonFacts& facts)
    : rviz::SelectionHandler(context), facts_(facts) {}

void TendonSelection::createProperties(const rviz::Picked& /*picked*/, rviz::Property* parent) {
  auto* group = new rviz::Property("Tendon", QString::fromStdString(facts_.name),
                                   "The muscle that pulls at this tendon.", parent);
  group->setReadOnly(true);
  properties_.push_back(group);
  force_ = new rviz::StringProperty("Force", "", "Of the spring.", group);
  slack_ = new rviz::StringProperty("Slack", "", "Whether the spring carries no force.", group);
  length_ = new rviz::StringProperty("Length", "", "Of the path, as it is drawn.", group);
  for (rviz::Property* property : {force_, slack_, length_}) property->setReadOnly(true);
  group->expand();
  updateProperties();
}

void TendonSelection::destroyProperties(const rviz::Picked& picked, rviz::Property* parent) {
  force_ = slack_ = length_ = nullptr;
  rviz::SelectionHandler::destroyProperties(picked, parent);
}

void TendonSelection::updateProperties() {
  if (force_ == nullptr) return;
  tell(force_, force_text(facts_));
  tell(slack_, slack_text(facts_));
  tell(length_, length_text(facts_));
}

}  // namespace anthrob
