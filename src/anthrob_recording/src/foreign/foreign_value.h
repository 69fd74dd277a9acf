#pragma once

#include <set>
#include <string>
#include <vector>

#include "anthrob_core/config_node.h"
#include "foreign/foreign_sheet.h"

namespace anthrob {

/// What a `from` of a columns file says: a column, or something that is made of columns.
///   from: "y [mm]"                                  a column by its name
///   from: {place: 2, scale: 0.001, offset: 1}       by its place; scale and offset go with any map
///   from: {sum: [a, {column: b, scale: -1}]}        also product, difference, quotient
///   from: {derivative: {smooth: a, over: 0.02}}     also integral, clip, within, unwrap, fresh
/// docs/files.md has them all.
class ForeignValue {
 public:
  /// @throws BadInput with file, line, key, value, what was expected
  static ForeignValue load(const ConfigNode& node);

  /// Adds the columns that it is made of.
  void collect(std::set<ForeignColumn>& columns) const;
  /// One number a row, NaN where it was not measured.
  /// @throws BadInput if `over` is too short for the samples
  std::vector<double> of(const ForeignSheet& sheet) const;

 private:
  explicit ForeignValue(const ConfigNode& node) : node_(node) {}
  static ForeignValue load(const ConfigNode& node, int depth);
  void load_parts(const ConfigNode& list, int depth);
  void load_numbers();
  std::vector<double> smooth(const ForeignSheet& sheet, const std::vector<double>& v) const;
  std::vector<double> limited(std::vector<double> v) const;
  std::vector<double> combined(const ForeignSheet& sheet) const;
  std::vector<double> operated(const ForeignSheet& sheet) const;

  ConfigNode node_;  ///< for messages
  std::string operation_ = "column";
  ForeignColumn column_;             ///< of `column`
  std::vector<ForeignValue> parts_;  ///< what the operation is done with
  double constant_ = 0.0, start_ = 0.0, over_ = 0.0, period_ = 0.0, low_ = 0.0, high_ = 0.0;
  double scale_ = 1.0, offset_ = 0.0;
};

/// A column by name, or by `{place: 2}`.
ForeignColumn load_foreign_column(const ConfigNode& node);

}  // namespace anthrob
