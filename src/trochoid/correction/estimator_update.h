#pragma once

struct TrochoidEstimator;  // of estimator.h

/// What the estimator does once a turn; not for hosts.
namespace trochoid::correction {

/// The model as it was given, and how far it is believed.
void begin_learning(TrochoidEstimator& e);

/// A whole turn whose forces stand in the result: L-9 to L-12.
void learn_turn(TrochoidEstimator& e);

}  // namespace trochoid::correction
