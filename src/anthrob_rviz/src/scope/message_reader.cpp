#include "scope/message_reader.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <string_view>
#include <utility>

namespace anthrob {
namespace {

using Kind = MessageField::Kind;
using Array = MessageField::Array;

// Longer lists are pictures and clouds, of which nobody plots each number over time.
constexpr std::uint32_t kMostEntries = 1000;
constexpr std::size_t kMostQuantities = 20000;  // of one message
constexpr std::size_t kMostContents = 100;      // kept of one topic

/// Reads within its bytes only; once it was asked for more, it is at its end and broken.
class ByteCursor {
 public:
  ByteCursor(const std::uint8_t* data, std::size_t size) : at_(data), left_(size) {}

  std::size_t left() const { return left_; }
  bool broken() const { return broken_; }
  const std::uint8_t* take(std::uint64_t count) {
    if (count > left_) {
      broken_ = true;
      left_ = 0;
      return nullptr;
    }
    const std::uint8_t* taken = at_;
    at_ += count;
    left_ -= static_cast<std::size_t>(count);
    return taken;
  }
  /// 0 beyond the end.
  template <class Number>
  Number number() {
    Number value{};
    if (const std::uint8_t* bytes = take(sizeof(Number)))
      std::memcpy(&value, bytes, sizeof(Number));
    return value;
  }
  std::string_view word() {
    const auto size = number<std::uint32_t>();
    const std::uint8_t* bytes = take(size);
    if (bytes == nullptr) return {};
    return {reinterpret_cast<const char*>(bytes), size};
  }

 private:
  const std::uint8_t* at_;
  std::size_t left_;
  bool broken_ = false;
};

double number_at(Kind kind, ByteCursor& bytes) {
  switch (kind) {
    case Kind::kBool:
    case Kind::kUint8:
      return bytes.number<std::uint8_t>();
    case Kind::kInt8:
      return bytes.number<std::int8_t>();
    case Kind::kInt16:
      return bytes.number<std::int16_t>();
    case Kind::kUint16:
      return bytes.number<std::uint16_t>();
    case Kind::kInt32:
      return bytes.number<std::int32_t>();
    case Kind::kUint32:
      return bytes.number<std::uint32_t>();
    case Kind::kInt64:
      return static_cast<double>(bytes.number<std::int64_t>());
    case Kind::kUint64:
      return static_cast<double>(bytes.number<std::uint64_t>());
    case Kind::kFloat32:
      return bytes.number<float>();
    case Kind::kFloat64:
      return bytes.number<double>();
    case Kind::kTime: {
      const auto seconds_part = bytes.number<std::uint32_t>();
      return seconds_part + 1e-9 * bytes.number<std::uint32_t>();
    }
    case Kind::kDuration: {
      const auto seconds_part = bytes.number<std::int32_t>();
      return seconds_part + 1e-9 * bytes.number<std::int32_t>();
    }
    case Kind::kString:
    case Kind::kMessage:
      break;
  }
  return std::nan("");
}

/// A list of words of a message.
struct Names {
  std::string_view field;
  std::vector<std::string_view> words;
};

/// The names of a list's entries: those of a list of words of the same length, preferably one that
/// is called name; else those of two whose product it is (a matrix, row by row).
class Labels {
 public:
  Labels(const std::vector<Names>& names, std::size_t count) {
    for (const Names& list : names) {
      if (list.words.size() != count) continue;
      if (rows_ == nullptr || list.field == "name") rows_ = &list;
    }
    if (rows_ == nullptr && names.size() == 2 &&
        names[0].words.size() * names[1].words.size() == count) {
      rows_ = &names[0], columns_ = &names[1];
    }
  }
  bool empty() const { return rows_ == nullptr; }
  std::string of(std::size_t entry) const {
    if (columns_ == nullptr) return std::string(rows_->words[entry]);
    const std::size_t width = columns_->words.size();
    return std::string(rows_->words[entry / width]) + "/" +
           std::string(columns_->words[entry % width]);
  }

 private:
  const Names* rows_ = nullptr;
  const Names* columns_ = nullptr;
};

/// Walks over one message. It collects the values and all that decides about their names, the key;
/// the names themselves only when that is asked for, because they seldom change.
class MessageWalk {
 public:
  MessageWalk(const MessageDefinition& definition, ByteCursor bytes, const std::string* topic)
      : definition_(definition), bytes_(bytes), naming_(topic != nullptr) {
    if (naming_) path_ = group_ = topic_ = *topic;
  }

  /// @return whether the message was as long as it should be
  bool run() {
    walk_message(0, {});
    return !bytes_.broken() && bytes_.left() == 0;
  }

  std::optional<Nanoseconds> stamp;
  std::vector<double> values;
  std::string key;
  MessageContents contents;

 private:
  using Unit = std::optional<std::string>;

  void walk_message(std::size_t index, const Unit& unit) {
    const MessageFields& message = definition_.messages[index];
    // Without bytes there is no number, however many fields there are.
    if (message.least_size == 0) return;
    if (bytes_.left() < message.least_size) return give_up();
    const std::vector<Names> names = message.named ? names_of(message) : std::vector<Names>();
    for (const MessageField& field : message.fields) {
      if (bytes_.broken()) return;
      walk_field(message, field, unit_of(message, field, unit), names, index == 0);
    }
    if (message.is_quaternion) emit_angle();
  }

  Unit unit_of(const MessageFields& message, const MessageField& field,
               const Unit& inherited) const {
    if (!naming_) return std::nullopt;
    if (field.unit) return field.unit;
    const auto standard = standard_unit(message.type, field.name);
    return standard ? standard : inherited;
  }

  void walk_field(const MessageFields& message, const MessageField& field, const Unit& unit,
                  const std::vector<Names>& names, bool top) {
    if (field.array != Array::kNone) return walk_list(field, unit, names);
    if (field.kind == Kind::kString) {
      bytes_.word();
    } else if (field.kind == Kind::kMessage) {
      const Entered entered(*this, field.name, true);
      in_top_header_ = top && definition_.messages[field.message].type == "std_msgs/Header";
      walk_message(field.message, unit);
      in_top_header_ = false;
    } else if (in_top_header_ && field.kind == Kind::kTime) {
      take_stamp();
    } else {
      // The parts of a vector are plotted together.
      const Entered entered(*this, field.name, &message == &definition_.messages[0]);
      emit(number_at(field.kind, bytes_), field.name, unit);
    }
  }

  void walk_list(const MessageField& field, const Unit& unit, const std::vector<Names>& names) {
    const std::uint32_t count =
        field.array == Array::kFixed ? field.count : bytes_.number<std::uint32_t>();
    add_to_key(count);
    const std::uint64_t least = field.kind == Kind::kMessage
                                    ? definition_.messages[field.message].least_size
                                    : size_of(field.kind).value_or(4);
    if (least == 0) return;
    if (count > bytes_.left() / least) return give_up();
    const Entered entered(*this, field.name, true);
    if (field.kind == Kind::kString || count > kMostEntries) return skip_entries(field, count);
    const Labels labels(names, count);
    std::set<std::string> seen;
    for (std::uint32_t i = 0; i < count && !bytes_.broken(); ++i)
      walk_entry(field, unit, labels, i, seen);
  }

  void walk_entry(const MessageField& field, const Unit& unit, const Labels& labels,
                  std::uint32_t i, std::set<std::string>& seen) {
    std::string label;
    const bool message = field.kind == Kind::kMessage;
    if (message && labels.empty()) label = own_name(definition_.messages[field.message]);
    if (naming_) {
      if (!labels.empty()) label = labels.of(i);
      // A second one of that name would be the same quantity.
      if (label.empty() || !seen.insert(label).second) label += "[" + std::to_string(i) + "]";
    }
    const Entered entered(*this, label, false);
    if (message) return walk_message(field.message, unit);
    emit(number_at(field.kind, bytes_), label, unit);
  }

  /// The name that a message of a list bears itself.
  std::string own_name(const MessageFields& message) {
    ByteCursor ahead = bytes_;
    for (const MessageField& field : message.fields) {
      const bool single = field.kind == Kind::kString && field.array == Array::kNone;
      if (single && (field.name == "name" || field.name == "child_frame_id")) {
        const std::string_view word = ahead.word();
        if (!ahead.broken()) add_to_key(word);
        return std::string(word);
      }
      skip_field(field, ahead);
      if (ahead.broken()) break;
    }
    return {};
  }

  std::vector<Names> names_of(const MessageFields& message) {
    std::vector<Names> names;
    ByteCursor ahead = bytes_;
    for (const MessageField& field : message.fields) {
      if (field.kind != Kind::kString || field.array == Array::kNone) {
        skip_field(field, ahead);
      } else {
        names.push_back({field.name, words_of(field, ahead)});
      }
      if (ahead.broken()) return {};
    }
    return names;
  }

  std::vector<std::string_view> words_of(const MessageField& field, ByteCursor& ahead) {
    std::vector<std::string_view> words;
    const std::uint32_t count =
        field.array == Array::kFixed ? field.count : ahead.number<std::uint32_t>();
    if (count > ahead.left() / 4) {
      ahead.take(ahead.left() + 1);
      return words;
    }
    for (std::uint32_t i = 0; i < count && !ahead.broken(); ++i) {
      words.push_back(ahead.word());
      add_to_key(words.back());
    }
    return words;
  }

  void skip_entries(const MessageField& field, std::uint32_t count) {
    if (field.kind != Kind::kString && naming_) {
      contents.left_out.push_back(path_ + " (" + std::to_string(count) + " entries)");
    }
    MessageField entry = field;
    entry.array = Array::kNone;
    if (const auto size = size_of(field.kind)) {
      bytes_.take(std::uint64_t{*size} * count);
      return;
    }
    for (std::uint32_t i = 0; i < count && !bytes_.broken(); ++i) skip_field(entry, bytes_);
  }

  void skip_field(const MessageField& field, ByteCursor& bytes) const {
    std::uint64_t count = 1;
    if (field.array == Array::kFixed) count = field.count;
    if (field.array == Array::kVariable) count = bytes.number<std::uint32_t>();
    if (const auto size = size_of(field.kind)) {
      bytes.take(*size * count);
      return;
    }
    const bool word = field.kind == Kind::kString;
    if (!word && definition_.messages[field.message].least_size == 0) return;
    for (std::uint64_t i = 0; i < count && !bytes.broken(); ++i) {
      if (word)
        bytes.word();
      else
        skip_message(definition_.messages[field.message], bytes);
    }
  }

  void skip_message(const MessageFields& message, ByteCursor& bytes) const {
    for (const MessageField& field : message.fields) {
      if (bytes.broken()) return;
      skip_field(field, bytes);
    }
  }

  void take_stamp() {
    const auto whole = bytes_.number<std::uint32_t>();
    const auto rest = bytes_.number<std::uint32_t>();
    const Nanoseconds t = Nanoseconds{whole} * 1000000000 + rest;
    if (t != 0) stamp = t;
  }

  void emit(double value, const std::string& name, const Unit& unit) {
    if (values.size() == kMostQuantities) {
      if (naming_ && !full_) contents.left_out.push_back(path_ + " and what follows");
      full_ = true;
      return;
    }
    values.push_back(value);
    if (!naming_) return;
    contents.quantities.push_back({path_, topic_, group_, label_.empty() ? name : label_, unit});
  }

  void emit_angle() {
    if (values.size() < 4 || full_) return;
    const double* q = &values[values.size() - 4];
    const double angle = angle_of(q[3], q[0], q[1], q[2]);
    const Entered entered(*this, "angle", false);
    if (naming_) group_ += "/angle";
    emit(angle, "angle", "rad");
    if (naming_) group_.resize(group_.size() - 6);
  }

  void give_up() { bytes_.take(std::uint64_t{bytes_.left()} + 1); }

  void add_to_key(std::uint32_t count) {
    key.append(reinterpret_cast<const char*>(&count), sizeof(count));
  }
  void add_to_key(std::string_view word) {
    add_to_key(static_cast<std::uint32_t>(word.size()));
    key += word;
  }

  /// Below a name, for as long as it lives. Names of fields make groups, all others make labels.
  class Entered {
   public:
    Entered(MessageWalk& walk, const std::string& name, bool groups)
        : walk_(walk),
          path_(walk.path_.size()),
          group_(walk.group_.size()),
          label_(walk.label_.size()) {
      if (!walk.naming_) return;
      walk.path_ += "/" + name;
      std::string& part = groups ? walk.group_ : walk.label_;
      if (groups || !part.empty()) part += "/";
      part += name;
    }
    ~Entered() {
      walk_.path_.resize(path_), walk_.group_.resize(group_), walk_.label_.resize(label_);
    }
    Entered(const Entered&) = delete;
    Entered& operator=(const Entered&) = delete;

   private:
    MessageWalk& walk_;
    std::size_t path_, group_, label_;
  };

  const MessageDefinition& definition_;
  ByteCursor bytes_;
  bool naming_;
  bool full_ = false, in_top_header_ = false;
  std::string topic_, path_, group_, label_;
};

}  // namespace

MessageReader::MessageReader(std::string topic, MessageDefinition definition)
    : topic_(std::move(topic)), definition_(std::move(definition)) {}

std::optional<MessageNumbers> MessageReader::read(const std::uint8_t* data, std::size_t size) {
  MessageWalk walk(definition_, ByteCursor(data, size), nullptr);
  if (!walk.run()) return std::nullopt;
  if (known_.size() == kMostContents && known_.count(walk.key) == 0) known_.clear();
  auto& contents = known_[walk.key];
  if (!contents) {
    MessageWalk naming(definition_, ByteCursor(data, size), &topic_);
    naming.run();
    contents = std::make_shared<MessageContents>(std::move(naming.contents));
  }
  return MessageNumbers{walk.stamp, std::move(walk.values), contents};
}

}  // namespace anthrob
