#pragma once

#include <trochoid/force/sensor.h>
#include <trochoid/identification/channel_fit.h>
#include <trochoid/results/columns.h>
#include <trochoid/results/fields.h>
#include <trochoid/results/identify.h>

#include <string>
#include <vector>

/// What a fit to the channels of a sensor says beyond those to three forces.
namespace trochoid::results {

/// A fit, and the channels that it is of.
struct FitOfChannels {
  const identification::Fit& fit;
  const SensorOfFit& sensor;
};

/// @brief Its keys in an entry of `fits`.
const Fields<FitOfChannels>& channel_fit_fields();

/// @brief channels.csv: what the channels read, and what the chosen fit makes of it.
const Columns<FitOfChannels>& channel_columns_of_fit();

/// @brief What is known of coefficients that are not known alone:
/// `K_tc + 19.6 K_te = 1800 +- 20 MPa`.
std::vector<std::string> sums_in_words(const identification::Fit& fit);

/// @brief Lines below the table of fits.
std::string channel_lines(const FitOfChannels& of);

/// `u, -v, torque`
std::vector<std::string> channel_names(const force::Sensor& sensor);

/// The same as a list.
Value channel_names_value(const force::Sensor& sensor);

/// Numbers of the channels, from 1, that read such a unit.
std::vector<std::string> channels_of_unit(const force::Sensor& sensor,
                                          force::ChannelUnit unit);

/// The channel behind the k-th of these.
std::size_t channel_at(const force::Sensor& sensor, force::ChannelUnit unit,
                       std::size_t k);

}  // namespace trochoid::results
