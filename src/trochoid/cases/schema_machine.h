#pragma once

#include <trochoid/cases/machine_tables.h>
#include <trochoid/cases/program_tables.h>
#include <trochoid/cases/schema.h>

namespace trochoid::cases {

void describe(const Visitor& v, CutterBody& t);
void describe(const Visitor& v, Wall& t);
void describe(const Visitor& v, WallPass& t);
void describe(const Visitor& v, Surface& t);
void describe(const Visitor& v, SurfaceMeasurement& t);
void describe(const Visitor& v, Mode& t);
void describe(const Visitor& v, Actuator& t);
void describe(const Visitor& v, FrfTables& t);
void describe(const Visitor& v, MeasuredFrf& t);
void describe(const Visitor& v, StepTables& t);
void describe(const Visitor& v, ImposedCommand& t);
void describe(const Visitor& v, Correction& t);
void describe(const Visitor& v, Spindle& t);
void describe(const Visitor& v, Controller& t);
void describe(const Visitor& v, Stability& t);
void describe(const Visitor& v, NcProgram& t);
void describe(const Visitor& v, Stock& t);
void describe(const Visitor& v, ForceLimits& t);
void describe(const Visitor& v, MachineDrives& t);
void describe(const Visitor& v, FeedRules& t);

}  // namespace trochoid::cases
