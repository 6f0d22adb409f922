#include <trochoid/cases/schema_choice.h>
#include <trochoid/cases/schema_machine.h>
#include <trochoid/cases/tables.h>

namespace trochoid::cases {

void describe(const Visitor& v, SurfaceMeasurement& t) {
  v({.name = "file",
     .meaning = "the measured surface, relative to the file that names it",
     .need = Need::always,
     .file = "a measured surface (csv, x3p or sdf)"},
    &t.source.file);
  v({.name = "of",
     .meaning = "what was measured; wall: its error, which tells forces; finish: a "
                "roughness trace along the feed, which tells how far teeth stand out"},
    choice(t.of));
  v({.name = "floor_y_mm",
     .meaning = "finish: the trace is on the floor, so far from the axis across the "
                "feed; left out: it is on the wall, at height_mm",
     .range = between(-longest_mm, longest_mm),
     .example = "0"},
    &t.floor_y);
  v({.name = "datum_offset", .meaning = "estimate a constant shift of the readings"},
    &t.datum_offset);
  v({.name = "datum_tilt",
     .meaning = "estimate a tilt of the readings along and across the feed"},
    &t.datum_tilt);
  v({.name = "form",
     .meaning = "form of the wall that is no work of the cut, estimated beside the "
                "coefficients; tilt has an offset as well, curvature both; auto: as "
                "the readings decide, at least what datum_offset and datum_tilt ask "
                "for; for quasi_static none"},
    choice(t.form, "auto"));
  v({.name = "unit",
     .meaning = "unit of lengths whose column names none; as_named: every column must"},
    choice(t.source.unit, "as_named"));
  v({.name = "height_mm",
     .meaning =
         "height above the tip of a trace along the feed on the wall, whose file "
         "has no column of heights; its column Z is the error",
     .range = between(0, 10000),
     .example = "1.5"},
    &t.source.height);
  v({.name = "frame",
     .meaning = "how the wall lies in the coordinates X, Y, Z of the file: feed, where "
                "the tool goes; normal, out of the material; up, towards the shank; "
                "origin_mm, the start of the wall at the tip of the tool",
     .example = "{ origin_mm = [12, -5, 40], feed = \"+x\", normal = \"-y\", "
                "up = \"+z\" }"},
    &t.source.frame);
}

void describe(const Visitor& v, files::SurfaceFrame& t) {
  v({.name = "origin_mm",
     .meaning = "start of the wall as it should be, at the tip of the tool",
     .range = between(-1e6, 1e6),
     .count = 3},
    &t.origin);
  v({.name = "feed",
     .meaning = "where the tool goes along the wall",
     .range = between(-1e6, 1e6),
     .need = Need::always},
    &t.feed);
  v({.name = "normal",
     .meaning = "out of the material: where it is left the error is positive",
     .range = between(-1e6, 1e6),
     .need = Need::always},
    &t.normal);
  v({.name = "up",
     .meaning = "from the tip of the tool to the shank",
     .range = between(-1e6, 1e6),
     .standard = "completes feed, normal, up to a right-handed frame"},
    &t.up);
}

}  // namespace trochoid::cases
