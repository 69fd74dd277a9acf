#include "plot/quantity_tree.h"

#include <QHeaderView>
#include <QStringList>
#include <vector>

namespace anthrob {
namespace {

constexpr int kPath = Qt::UserRole;  // of a leaf

QString path_of(const QTreeWidgetItem* item) {
  return item->data(0, kPath).toString();
}

void make_checkable(QTreeWidgetItem* item, bool leaf) {
  Qt::ItemFlags flags = Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable;
  if (!leaf) flags |= Qt::ItemIsAutoTristate;
  item->setFlags(flags);
  item->setCheckState(0, Qt::Unchecked);
}

/// Hides what does not match. @return whether anything of it is left
bool filter_item(QTreeWidgetItem* item, const QString& text, const QString& above) {
  const QString whole = above + "/" + item->text(0);
  bool left = whole.contains(text, Qt::CaseInsensitive) && item->childCount() == 0;
  for (int i = 0; i < item->childCount(); ++i)
    left = filter_item(item->child(i), text, whole) || left;
  item->setHidden(!left && !whole.contains(text, Qt::CaseInsensitive));
  return !item->isHidden();
}

/// What is plotted is to be seen in the tree.
void tick_and_reveal(QTreeWidgetItem* item) {
  item->setCheckState(0, Qt::Checked);
  while ((item = item->parent()) != nullptr) item->setExpanded(true);
}

}  // namespace

QuantityTree::QuantityTree(QWidget* parent) : QTreeWidget(parent) {
  setObjectName("quantities");
  setHeaderLabels({"Quantity", "Unit"});
  header()->setSectionResizeMode(0, QHeaderView::Stretch);
  header()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
  header()->setStretchLastSection(false);
  setUniformRowHeights(true);
  later_.setSingleShot(true);
  later_.setInterval(0);
  // A tick of a branch changes many leaves: they are passed on together.
  connect(&later_, &QTimer::timeout, this, [this] { pass_on(); });
  connect(this, &QTreeWidget::itemChanged, this, [this](QTreeWidgetItem* item) { hear(item); });
  const auto opened = [this](QTreeWidgetItem* item) {
    if (item->parent() == nullptr && on_open_) on_open_();
  };
  connect(this, &QTreeWidget::itemExpanded, this, opened);
  connect(this, &QTreeWidget::itemCollapsed, this, opened);
}

QTreeWidgetItem* QuantityTree::topic_item(const std::string& topic) {
  QTreeWidgetItem*& item = topics_[topic];
  if (item != nullptr) return item;
  item = new QTreeWidgetItem(QStringList(QString::fromStdString(topic)));
  item->setToolTip(0, QString::fromStdString(topic));
  addTopLevelItem(item);
  make_checkable(item, false);
  sortItems(0, Qt::AscendingOrder);
  return item;
}

QTreeWidgetItem* QuantityTree::add(const Quantity& quantity) {
  QTreeWidgetItem* item = topic_item(quantity.topic);
  std::string path = quantity.topic;
  const auto parts = QString::fromStdString(quantity.path.substr(quantity.topic.size()))
                         .split('/', Qt::SkipEmptyParts);
  for (int i = 0; i < parts.size(); ++i) {
    path += "/" + parts[i].toStdString();
    const bool leaf = i + 1 == parts.size();
    QTreeWidgetItem*& child = leaf ? leaves_[quantity.path] : branches_[path];
    if (child == nullptr) {
      child = new QTreeWidgetItem(item, {parts[i]});
      make_checkable(child, leaf);
    }
    item = child;
  }
  item->setData(0, kPath, QString::fromStdString(quantity.path));
  item->setText(1, QString::fromStdString(quantity.unit.value_or(std::string())));
  item->setToolTip(0, QString::fromStdString(quantity.path));
  return item;
}

void QuantityTree::remove(QTreeWidgetItem* item) {
  QTreeWidgetItem* parent = item->parent();
  const auto forget = [item](std::map<std::string, QTreeWidgetItem*>& items) {
    for (auto it = items.begin(); it != items.end();)
      it = it->second == item ? items.erase(it) : std::next(it);
  };
  forget(leaves_), forget(branches_), forget(topics_);
  delete item;
  if (parent != nullptr && parent->childCount() == 0 && parent->parent() != nullptr) remove(parent);
}

void QuantityTree::remove_others(const std::map<std::string, Quantity>& quantities,
                                 const std::set<std::string>& topics) {
  std::vector<QTreeWidgetItem*> gone;
  for (const auto& [path, item] : leaves_) {
    if (quantities.count(path) == 0) gone.push_back(item);
  }
  for (QTreeWidgetItem* item : gone) remove(item);
  gone.clear();
  for (const auto& [topic, item] : topics_) {
    if (topics.count(topic) == 0 && item->childCount() == 0) gone.push_back(item);
  }
  for (QTreeWidgetItem* item : gone) remove(item);
}

void QuantityTree::show_quantities(const std::map<std::string, Quantity>& quantities,
                                   const std::set<std::string>& topics,
                                   const std::set<std::string>& ticked) {
  filling_ = true;
  setUpdatesEnabled(false);
  remove_others(quantities, topics);
  for (const auto& [path, quantity] : quantities) {
    if (leaves_.count(path) > 0) continue;
    QTreeWidgetItem* item = add(quantity);
    if (ticked.count(path) > 0) tick_and_reveal(item);
  }
  for (const std::string& topic : topics) {
    QTreeWidgetItem* item = topic_item(topic);
    const bool known = item->childCount() > 0;
    item->setChildIndicatorPolicy(known ? QTreeWidgetItem::DontShowIndicatorWhenChildless
                                        : QTreeWidgetItem::ShowIndicator);
    item->setText(1, !known && item->isExpanded() ? "waits for a message" : QString());
  }
  for (const auto& [topic, item] : topics_) {
    if (item->childCount() > 0) item->setText(1, QString());
  }
  filter(filter_);
  setUpdatesEnabled(true);
  filling_ = false;
}

void QuantityTree::filter(const QString& text) {
  filter_ = text;
  for (int i = 0; i < topLevelItemCount(); ++i) filter_item(topLevelItem(i), text, QString());
}

std::set<std::string> QuantityTree::open_topics() const {
  std::set<std::string> open;
  for (const auto& [topic, item] : topics_) {
    if (item->isExpanded()) open.insert(topic);
  }
  return open;
}

void QuantityTree::tick(const std::string& path, bool ticked) {
  const auto found = leaves_.find(path);
  if (found != leaves_.end()) found->second->setCheckState(0, ticked ? Qt::Checked : Qt::Unchecked);
}

void QuantityTree::show_ticks(const std::set<std::string>& ticked) {
  filling_ = true;
  for (const auto& [path, item] : leaves_) {
    item->setCheckState(0, Qt::Unchecked);
    if (ticked.count(path) > 0) tick_and_reveal(item);
  }
  filling_ = false;
}

void QuantityTree::hear(QTreeWidgetItem* item) {
  const QString path = path_of(item);
  if (filling_ || path.isEmpty()) return;
  changed_[path.toStdString()] = item->checkState(0) == Qt::Checked;
  later_.start();
}

void QuantityTree::pass_on() {
  std::set<std::string> ticked, cleared;
  for (const auto& [path, now] : changed_) (now ? ticked : cleared).insert(path);
  changed_.clear();
  if (!on_tick_) return;
  if (!cleared.empty()) on_tick_(cleared, false);
  if (!ticked.empty()) on_tick_(ticked, true);
}

}  // namespace anthrob
