#pragma once

#include <trochoid/cases/findings.h>
#include <trochoid/cases/tables.h>

/// What the keys of a case must fulfil together. Each function reports
/// what is wrong, fills in the defaults that depend on other keys, and
/// turns tables into what the rooms below work with. Nothing is reported
/// that follows from a problem reported before.
namespace trochoid::cases {

struct DataInMemory;

geometry::Cutter cutter_of(ToolTable& tool, Findings& findings);
void check_runout(geometry::Runout& runout, const ToolTable& tool, Findings& findings);
/// @brief Edges that differ from tooth to tooth: whether they can be, and whether the
/// command takes them.
void check_edges(CaseTables& tables, const force::Setup& setup, Command purpose,
                 Findings& findings);

/// @param path  `cut`, or `measurement[1].cut`
geometry::Cut cut_of(CutTable& cut, const std::string& path,
                     const geometry::Cutter& cutter, Findings& findings);

void check_chip(const chip::ChipModel& chip, Findings& findings);
/// @brief Process damping; fills in its friction.
/// @param purpose  by others than stability, dynamics and correct it is not felt: a note
force::ProcessDamping damping_of(ForceTable& force, Command purpose,
                                 Findings& findings);
/// @brief Of [orthogonal] and the coefficients in its place, what is inherited gives way to
/// what is not.
Node without_outvoted_coefficients(Node root);
/// @brief The coefficients that [orthogonal] stands for; afterwards [force] has them.
/// @param purpose  one that finds coefficients is not told of these
void settle_orthogonal(CaseTables& tables, const force::Setup& setup, Command purpose,
                       Findings& findings);
force::Law law_of(ForceTable& force, bool exponents_default);
void check_sampling(Sampling& sampling, Findings& findings);

/// @brief Chip models that know no serration are refused, or left out where nobody asked.
void settle_serrated_models(CaseTables& tables, Findings& findings);

Dynamometer dynamometer_of(DynamometerTable& table, Findings& findings);

/// @brief What is measured, without its cut.
/// @param number  1, 2 ... of the [[measurement]]
Measurement measurement_of(MeasurementTable& table, std::size_t number,
                           Findings& findings);

Identify identify_of(const IdentifyTable& table, const CaseTables& tables,
                     Findings& findings);

/// @brief Channels, their standard deviations, means and the prior against one another;
/// decides whether the channels are fitted as they are.
void settle_channels(const CaseTables& tables, Command purpose, Findings& findings,
                     Case& c);

void check_machine(MachineTables& machine, const ToolTable& tool, Findings& findings);

/// @brief What a surface needs so that there is one finished wall; fills in [surface].
/// @param verb  `surface` or `calibrate`, for messages
void check_wall_cut(CaseTables& tables, std::string_view verb, Findings& findings);

/// @brief Whether what was measured are roughness traces.
bool is_finish(const MachineTables& machine);

/// @brief What roughness traces need; fills in [surface].
void check_finish(CaseTables& tables, Findings& findings);

/// @brief Whether a surface is asked for of which only the floor is wanted.
bool is_floor_only(const CaseTables& tables, std::string_view verb);

/// @brief Heights, cut, flutes and wall against one another.
void check_surface(CaseTables& tables, Findings& findings);

/// @brief Where the deflection under the loads of [wall] is wanted.
void check_wall_loads(const Wall& wall, Findings& findings);

/// @brief [[pass]] and also_bends against what they need.
void check_passes(const CaseTables& tables, Findings& findings);

/// @brief What `surface` knows and `calibrate` does not.
void refuse_for_calibrate(const MachineTables& machine, Findings& findings);

/// @brief Modes that the chip can feel, and the
/// ranges of the lobes; fills in [stability].
void check_stability(CaseTables& tables, Findings& findings);

/// @brief What motion in time needs: a cylinder of equal pitch, modes along x or y,
/// whole revolutions, and a table along x for an actuator.
void check_dynamics(const CaseTables& tables, Findings& findings);

/// @brief What a correction needs: all of check_dynamics, an actuator with its table,
/// and runout or a record to find it in; fills in [correct].
void check_correct(CaseTables& tables, Findings& findings);

/// @brief What a plan needs: cuts to look at and what they are to tell; fills in [plan].
void check_plan(CaseTables& tables, Findings& findings);

/// @brief What the tables of a whole NC program must fulfil together; settles names of
/// offsets and words.
void check_program(CaseTables& tables, Findings& findings);

/// @brief What is known of the program beside its text.
program::ReadOptions read_options(const ProgramTables& nc);

/// @brief What a plan of this case is about: as [plan] says, else as the other tables show.
PlanOf planned(const CaseTables& tables);

/// @brief Whether [plan] is of forces, a wall or a finish, if it does not say so itself;
/// what belongs to another kind is reported.
void settle_plan(CaseTables& tables, Findings& findings);

/// @brief What a plan of a wall needs; fills in [plan].
void check_wall_plan(CaseTables& tables, Findings& findings);

/// @brief What a plan of a finish needs; fills in its feeds.
void check_finish_plan(CaseTables& tables, Findings& findings);

/// A coefficient without its unit: K_tc of K_tc_MPa.
std::string_view plain_name(std::string_view key);

/// @brief First below last, and a whole number of them.
/// @param what  `values` or `speeds`, for the message
void check_steps(const std::optional<base::Steps>& steps, const std::string& key,
                 std::string_view what, double most, Findings& findings);

/// @brief Its frame: perpendicular directions, which become unit vectors.
/// @param number  1, 2 ... of the [[surface_measurement]]
void settle_frame(files::SurfaceFrame& frame, std::size_t number, Findings& findings);

/// @brief Directions, bands, and that none is given twice, of all [[measured_frf]].
void check_measured_frfs(const std::vector<MeasuredFrf>& all, Findings& findings);

/// @brief What `modes` needs: a file in [frf], or [[measured_frf]] of one structure.
void check_shared_modes(const MachineTables& machine, Findings& findings);

/// @brief Find every file that a case names, on the disk or in memory.
void settle_files(CaseTables& tables, const DataInMemory& data, Findings& findings);

/// @brief Report those that are not there, unless more is wrong with their tables.
void check_files(CaseTables& tables, Findings& findings);

/// @brief Names of files as a case in that folder must have them; none: absolute.
void name_files_from(const std::filesystem::path& folder, CaseTables& tables);

/// @brief As given, or as mass and stiffness make it [Hz]; 0: it is not said, or wrongly.
double natural_frequency(const Mode& mode);

}  // namespace trochoid::cases
