#include "report/options_json.h"

namespace anthrob {
namespace discovery {

namespace {

using Json = nlohmann::ordered_json;

/// Writes numbers, and groups of them, under their names.
class Writer {
 public:
  explicit Writer(Json& json) : json_(json) {}

  void operator()(const char* name, const Share& share) const { json_[name] = share.value; }
  void operator()(const char* name, double number) const { json_[name] = number; }
  void operator()(const char* name, int number) const { json_[name] = number; }
  void operator()(const char* name, std::size_t number) const { json_[name] = number; }
  template <std::size_t n>
  void operator()(const char* name, const std::array<double, n>& numbers) const {
    json_[name] = numbers;
  }
  template <typename Group, typename = decltype(&Group::template visit<const Group, Writer>)>
  void operator()(const char* name, const Group& group) const {
    Group::visit(group, Writer(json_[name]));
  }

 private:
  Json& json_;
};

}  // namespace

Json options_json(const Options& options) {
  Json json;
  Options::visit(options, Writer(json));
  return json;
}

}  // namespace discovery
}  // namespace anthrob
