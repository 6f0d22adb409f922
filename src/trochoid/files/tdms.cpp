#include <trochoid/files/csv.h>
#include <trochoid/files/tdms.h>
#include <trochoid/files/tdms_segments.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace trochoid::files {

namespace {

const TdmsProperty* property(const TdmsObject& object, const std::string& key) {
  const auto at = object.properties.find(key);
  return at == object.properties.end() ? nullptr : &at->second;
}

std::optional<double> number(const TdmsObject& object, const std::string& key) {
  const auto* found = property(object, key);
  const auto* value = found != nullptr ? std::get_if<double>(found) : nullptr;
  return value != nullptr ? std::optional(*value) : std::nullopt;
}

std::string text(const TdmsObject& object, const std::string& key) {
  const auto* found = property(object, key);
  const auto* value = found != nullptr ? std::get_if<std::string>(found) : nullptr;
  return value != nullptr ? *value : std::string();
}

/// A polynomial from raw numbers to those of the unit, lowest power first.
using Scale = std::vector<double>;

constexpr double raw_input = 4294967295.0;
constexpr double most_scales = 100;

/// One `NI_Scale[i]_...`; `input` becomes the number of the scale before it.
Scale scale_of(const TdmsObject& object, double index, const std::string& name,
               double& input) {
  const auto prefix = fmt::format("NI_Scale[{}]_", index);
  const auto type = text(object, prefix + "Scale_Type");
  input = number(object, prefix + type + "_Input_Source").value_or(raw_input);
  if (type == "Linear") {
    return {number(object, prefix + "Linear_Y_Intercept").value_or(0.0),
            number(object, prefix + "Linear_Slope").value_or(1.0)};
  }
  if (type == "Polynomial") {
    Scale scale;
    const double size =
        number(object, prefix + "Polynomial_Coefficients_Size").value_or(4.0);
    for (double i = 0; i < std::min(size, most_scales); ++i) {
      scale.push_back(
          number(object, fmt::format("{}Polynomial_Coefficients[{}]", prefix, i))
              .value_or(0.0));
    }
    return scale;
  }
  refuse(name, fmt::format("channel {} is scaled by {}, which is not read, only Linear "
                           "and Polynomial: save it as scaled numbers",
                           excerpt(object.channel),
                           type.empty() ? "something unnamed" : excerpt(type)));
}

/// What leads from the raw numbers of a channel to its unit, in the order of use.
///
/// The last scale gives the numbers; each names the one that it takes its input from. For
/// DAQmx the raw numbers are scale 0 or whichever its scaler names.
std::vector<Scale> scales_of(const TdmsObject& object, const std::string& name) {
  std::vector<Scale> scales;
  const double count = number(object, "NI_Number_Of_Scales").value_or(0.0);
  if (!(count >= 1.0 && count <= most_scales) ||
      text(object, "NI_Scaling_Status") == "scaled") {
    return scales;
  }
  const bool daqmx = object.layout && object.layout->daqmx.has_value();
  const double raw = daqmx ? object.layout->daqmx->scale : raw_input;
  for (double at = count - 1.0; at != raw && at != raw_input;) {
    double input = raw_input;
    scales.push_back(scale_of(object, at, name, input));
    if (input != raw_input && !(input >= 0.0 && input < at)) {
      refuse(name, fmt::format("the scales of channel {} refer to each other in a "
                               "circle: the file is damaged",
                               excerpt(object.channel)));
    }
    at = input;
  }
  std::reverse(scales.begin(), scales.end());
  return scales;
}

double scaled(const Scale& scale, double x) {
  double y = 0.0;
  for (std::size_t i = scale.size(); i-- > 0;) y = y * x + scale[i];
  return y;
}

std::vector<double> values_of(std::istream& in, const TdmsObject& object,
                              const std::string& name) {
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(object.count()));
  for (const auto& run : object.runs) {
    if (!read_run(in, run, values)) refuse(name, "the file cannot be read to its end");
  }
  const bool times = object.runs.front().kind == NumberKind::timestamp;
  if (times) {  // counted from 1904; only the differences matter
    const double first = std::floor(values.front());
    for (auto& value : values) value -= first;
  }
  for (const Scale& scale : scales_of(object, name)) {
    for (auto& value : values) value = scaled(scale, value);
  }
  return values;
}

/// When the first of all channels was started; others count from there.
double started(const std::vector<TdmsObject>& objects) {
  for (const TdmsObject& object : objects) {
    if (const auto time = number(object, "wf_start_time")) return *time;
  }
  return 0.0;
}

NumericColumn column_of(const TdmsObject& object, double begin) {
  NumericColumn column{.name = object.channel,
                       .path = fmt::format("{}/{}", object.group, object.channel),
                       .unit = text(object, "unit_string"),
                       .count = static_cast<std::size_t>(object.count())};
  const double step = number(object, "wf_increment").value_or(0.0);
  if (step > 0.0) {
    column.sample_rate = 1.0 / step;
    // The difference first: seconds since 1904 leave no digits for an offset.
    column.first_time = number(object, "wf_start_offset").value_or(0.0) +
                        (number(object, "wf_start_time").value_or(begin) - begin);
  }
  const bool times =
      !object.runs.empty() && object.runs.front().kind == NumberKind::timestamp;
  if (times && column.unit.empty()) column.unit.assign(1, 's');
  return column;
}

}  // namespace

bool is_tdms(std::string_view head) {
  return head.starts_with("TDSm");
}

NumericTable tdms_table(std::istream& in, const std::string& name) {
  auto file = read_tdms_segments(in, name);
  std::erase_if(file.objects, [](const TdmsObject& object) {
    return object.channel.empty() || object.runs.empty() || object.count() == 0;
  });
  NumericTable table;
  const double begin = started(file.objects);
  for (const auto& object : file.objects) {
    table.columns.push_back(column_of(object, begin));
  }
  if (file.unfinished) {
    table.notes.push_back({"part_of_record",
                           "The file was not closed by the program that wrote it: its "
                           "last segment is read as far as it goes."});
  }
  const auto objects =
      std::make_shared<const std::vector<TdmsObject>>(std::move(file.objects));
  table.values = [&in, name, objects](std::size_t i) {
    return values_of(in, (*objects)[i], name);
  };
  return table;
}

signal::Record read_tdms_record(std::istream& in, const std::string& name,
                                const RecordSource& source) {
  return record_of(tdms_table(in, name), name, source);
}

}  // namespace trochoid::files
