#pragma once

#include <string_view>

/// The parts of the page, embedded when the program is built (embed.cmake).
namespace trochoid::report {

std::string_view page_html();  ///< the page, with places `{{name}}` to be filled
std::string_view uplot_css();
std::string_view page_css();
std::string_view uplot_js();
std::string_view uplot_licence();
std::string_view excel_js();  ///< writes a workbook
std::string_view excel_licence();
std::string_view fflate_licence();  ///< of what excel_js contains

// The scripts of page/, each needs those above it.
std::string_view text_js();      ///< numbers, names and elements
std::string_view band_js();      ///< what of a curve is in the band of a fit
std::string_view svg_js();       ///< a canvas that becomes a file
std::string_view save_js();      ///< pictures and data saved, tables behind
std::string_view drawing_js();   ///< canvases drawn by hand
std::string_view touch_js();     ///< zoom by fingers and by rectangles
std::string_view charts_js();    ///< curves
std::string_view parts_js();     ///< what several commands show
std::string_view measured_js();  ///< measured against computed
std::string_view simulate_js();
std::string_view groups_js();
std::string_view channels_js();
std::string_view identify_js();
std::string_view cutter_js();  ///< what a cutter looks like, in numbers
std::string_view tool_js();    ///< the tool of a case, drawn
std::string_view map_js();     ///< a quantity over two others
std::string_view bent_js();    ///< cutter and wall
std::string_view surface_js();
std::string_view wall_map_js();  ///< readings on a wall
std::string_view ellipse_js();   ///< two coefficients known together
std::string_view calibrate_js();
std::string_view calibrate_words_js();
std::string_view finish_js();  ///< roughness traces
std::string_view stability_js();
std::string_view correct_js();
std::string_view modes_js();  ///< modes and actuators
std::string_view dynamics_js();
std::string_view moving_js();  ///< the cut that moves, seen from above
std::string_view plan_js();
std::string_view sweep_js();
std::string_view plan_wall_js();
std::string_view plan_finish_js();
std::string_view program_js();  ///< path, lines and forces of an NC program
std::string_view any_js();      ///< every command without a page of its own
std::string_view compare_js();  ///< two answers beside one another
std::string_view main_js();

}  // namespace trochoid::report
