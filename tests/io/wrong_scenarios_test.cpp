// Each kind of wrong scenario, and the exact words, line and column that a user gets for it.
#include <gtest/gtest.h>

#include <sstream>

#include "io/scenario/scenario_reader.hpp"

namespace scree::io {
namespace {

struct Wrong {
    const char* name;
    const char* text;  // after three good lines if it begins with '+'
    std::vector<std::string> overrides;
    std::vector<const char*> errors;  // without "s.yaml:"
};

const char* const kGoodLines =
    "scenario_version: 1\n"
    "time: {end: 1, step: 1e-3}\n"
    "materials: {glass: {density: 2500}}\n";

std::string whole_text(const Wrong& wrong) {
    const std::string text = wrong.text;
    return !text.empty() && text.front() == '+' ? kGoodLines + text.substr(1) : text;
}

// The lines of a report that say what is wrong (not those that show the source).
std::vector<std::string> error_lines(const std::string& report) {
    std::vector<std::string> lines;
    std::istringstream stream(report);
    for (std::string line; std::getline(stream, line);) {
        const auto at = line.find(": error: ");
        if (at == std::string::npos) continue;
        if (line.rfind("s.yaml:", 0) == 0) line.erase(0, 7);
        lines.push_back(line);
    }
    return lines;
}

const std::vector<Wrong> kSyntax{
    {"empty", "", {}, {"1:1: error: the file is empty: expected the keys of a scenario"}},
    {"only_comments", "# nothing\n\n", {}, {"1:1: error: the file is empty: expected the keys of a scenario"}},
    {"a_word", "silo\n", {}, {"1:1: error: expected the keys of a scenario ('key: value')"}},
    {"a_list", "- silo\n", {}, {"1:1: error: expected the keys of a scenario ('key: value')"}},
    {"tab", "time:\n\tend: 1\n", {}, {"2:1: error: a tab in the indentation: YAML takes blanks only"}},
    {"binary", "a: 1\nb: \x01\n", {}, {"2:4: error: byte 0x01 is no text: a scenario is a YAML file in UTF-8"}},
    {"not_utf8", "title: caf\xe9\n", {}, {"1:11: error: byte 0xe9 is no text: a scenario is a YAML file in UTF-8"}},
    {"colon",
     "title: a: b\n",
     {},
     {"1:9: error: YAML: a ':' that cannot stand here: keys of one map begin in one "
      "column, and a text with ': ' needs quotes"}},
    {"open_bracket", "gravity: [0, 0\ntime: 1\n", {}, {"1:10: error: this '[' is not closed"}},
    {"open_brace", "time: {end: 1\nseed: 1\n", {}, {"1:7: error: this '{' is not closed"}},
    {"open_quote", "title: \"silo\n", {}, {"1:8: error: this quote is not closed"}},
    {"indentation",
     "time:\n    end: 1\n  step: 1\n",
     {},
     {"3:3: error: YAML: this line fits no map above it: keys of one map begin in one column"}},
    {"anchor", "seed: *s\n", {}, {"1:7: error: YAML: the referenced anchor is not defined"}},
    {"alias_in_itself", "walls: &w [*w]\n", {}, {"1:12: error: this alias stands inside the value that it refers to"}},
    {"two_documents",
     "a: 1\n---\nb: 1\n",
     {},
     {"3:1: error: a second document begins before here; a scenario is one document"}},
    {"tag", "+title: !name x\n", {}, {"4:8: error: the tag '!name' has no meaning here"}},
    {"merge_of_a_value", "+output: {<<: 3}\n", {}, {"4:14: error: '<<' takes a map, or a list of maps"}},
    {"key_is_a_list", "+? [a]\n: 1\n", {}, {"4:3: error: a key must be a name"}},
    {"duplicate", "+seed: 1\nseed: 2\n", {}, {"5:1: error: 'seed' is given twice; the first is on line 4"}},
    {"duplicate_in_flow",
     "+solver: {tolerance: 1, max_sweeps: 9, tolerance: 2}\n",
     {},
     {"4:39: error: 'tolerance' is given twice; the first is on line 4"}},
};

const std::vector<Wrong> kKeys{
    {"unknown_first_key",
     "+graviti: [0, 0, 0]\n",
     {},
     {"4:1: error: 'graviti' is not a key of the scenario (did you mean 'gravity'?); its keys are scenario_version, "
      "title, description, include, seed, origin, gravity, gravity_table, time, solver, correction, materials, pairs, "
      "shapes, bodies, walls, outlets, inlets, measures, rasters, trajectories, output"}},
    {"unknown_key",
     "+correction: {swep: 3}\n",
     {},
     {"4:14: error: 'swep' is not a key of correction (did you mean 'sweeps'?); its keys are enabled, sweeps, share"}},
    {"unknown_key_of_material",
     "scenario_version: 1\ntime: {end: 1, step: 1}\nmaterials: {a: {density: 1, colour: 2}}\n",
     {},
     {"3:29: error: 'colour' is not a key of materials.a; its keys are density, friction, restitution"}},
    {"key_of_another_form",
     "+walls:\n- {shape: plane, name: a, material: glass, point: [0, 0, 0], normal: [0, 0, 1], radius: 1}\n",
     {},
     {"5:81: error: 'radius' is not a key of walls[0] (shape: plane); its keys are shape, name, material, appears, "
      "goes, motion, point, normal"}},
    {"missing_sections",
     "scenario_version: 1\n",
     {},
     {"1:1: error: the scenario lacks the key 'time': expected a map with keys out of end, step, max_travel",
      "1:1: error: the scenario lacks the key 'materials': expected a map from names to maps"}},
    {"missing_keys",
     "scenario_version: 1\ntime: {end: 1}\nmaterials:\n  a: {friction: 0}\n",
     {},
     {"2:1: error: time lacks the key 'step': expected a time > 0 (s, ms, us, min, h)",
      "4:3: error: materials.a lacks the key 'density': expected a density > 0 (kg/m3, g/cm3, t/m3)"}},
    {"missing_form",
     "+walls:\n  - name: a\n",
     {},
     {"5:5: error: walls[0]: 'shape' is missing; expected one of plane, box, cylinder, cone, disc, orifice_floor, "
      "slot_floor, terrain"}},
    {"unknown_form",
     "+walls:\n  - shape: plain\n",
     {},
     {"5:12: error: walls[0].shape: 'plain' (did you mean 'plane'?); expected one of plane, box, cylinder, cone, disc, "
      "orifice_floor, slot_floor, terrain"}},
    {"form_not_allowed_here",
     "+inlets:\n- {name: a, material: glass, mass_rate: 1, size: {distribution: fixed, "
     "diameter: 1}, region: {shape: sphere}}\n",
     {},
     {"5:102: error: inlets[0].region.shape: 'sphere'; expected one of box"}},
    {"no_value", "+solver:\n  tolerance:\n", {}, {"5:3: error: solver.tolerance: no value; expected a number > 0"}},
    {"section_without_value",
     "+correction:\n",
     {},
     {"4:1: error: correction: no value; expected a map with keys out of enabled, sweeps, share"}},
    {"value_for_section",
     "+correction: 3\n",
     {},
     {"4:13: error: correction: '3'; expected a map with keys out of enabled, sweeps, share"}},
    {"map_for_list", "+walls: {shape: plane}\n", {}, {"4:8: error: walls: a map; expected a list of maps"}},
    {"word_in_list",
     "+walls: [floor]\n",
     {},
     {"4:9: error: walls[0]: 'floor'; expected a map with the key 'shape', one of plane, box, cylinder, cone, disc, "
      "orifice_floor, slot_floor, terrain"}},
    {"list_for_materials",
     "scenario_version: 1\ntime: {end: 1, step: 1}\nmaterials: [a]\n",
     {},
     {"3:12: error: materials: a list; expected a map from names to maps"}},
    {"two_of_a_group",
     "+bodies:\n- {generator: sphere, material: glass, position: [0, 0, 0], radius: 1, diameter: 2}\n",
     {},
     {"5:72: error: 'radius' and 'diameter' of bodies[0] (generator: sphere) exclude each other; keep one"}},
    {"none_of_a_group",
     "+bodies:\n- {generator: sphere, material: glass, position: [0, 0, 0]}\n",
     {},
     {"5:3: error: bodies[0] (generator: sphere) lacks one of the keys radius, diameter"}},
    {"two_gravities",
     "+gravity: [0, 0, 0]\ngravity_table: [[0, 0, 0, 0]]\n",
     {},
     {"5:1: error: 'gravity' and 'gravity_table' of the scenario exclude each other; keep one"}},
};

const std::vector<Wrong> kValues{
    {"later_version",
     "scenario_version: 2\ntime: {end: 1, step: 1}\nmaterials: {}\n",
     {},
     {"1:19: error: scenario_version: '2' is out of range; expected an integer = 1"}},
    {"word_for_number",
     "+solver: {tolerance: fine}\n",
     {},
     {"4:21: error: solver.tolerance: 'fine' is not a number; expected a number > 0"}},
    {"list_for_number",
     "+solver: {tolerance: [1]}\n",
     {},
     {"4:21: error: solver.tolerance: a list; expected a number > 0"}},
    {"quoted_number",
     "+solver: {tolerance: \"0.1\"}\n",
     {},
     {"4:21: error: solver.tolerance: '0.1' is a text, because of its quotes; expected a number > 0"}},
    {"underscore",
     "+solver: {look_ahead: 1_000}\n",
     {},
     {"4:22: error: solver.look_ahead: '1_000' is not a number; expected a number >= 0"}},
    {"decimal_comma",
     "+solver: {look_ahead: \"0,5\", block_size: '1,5 m'}\n",
     {},
     {"4:22: error: solver.look_ahead: '0,5' is a text, because of its quotes; expected a number >= 0",
      "4:41: error: solver.block_size: '1,5 m' is not a number; expected a length >= 0 (m, cm, mm, um, km)"}},
    {"negative",
     "+solver: {block_size: -1 mm}\n",
     {},
     {"4:22: error: solver.block_size: '-1 mm' is out of range; expected a length >= 0 (m, cm, mm, um, km)"}},
    {"zero",
     "+solver: {tolerance: 0}\n",
     {},
     {"4:21: error: solver.tolerance: '0' is out of range; expected a number > 0"}},
    {"above",
     "+correction: {share: 1.01}\n",
     {},
     {"4:21: error: correction.share: '1.01' is out of range; expected a number 0 to 1"}},
    {"nan",
     "+correction: {share: .nan}\n",
     {},
     {"4:21: error: correction.share: .nan is not finite; expected a number 0 to 1"}},
    {"infinite",
     "+solver: {look_ahead: inf}\n",
     {},
     {"4:22: error: solver.look_ahead: inf is not finite; expected a number >= 0"}},
    {"too_large_for_double",
     "+solver: {look_ahead: 1e999}\n",
     {},
     {"4:22: error: solver.look_ahead: 1e999 is beyond the range of double precision; expected a number >= 0"}},
    {"wrong_dimension",
     "+solver: {block_size: 6 kg}\n",
     {},
     {"4:22: error: solver.block_size: '6 kg' is a mass; expected a length >= 0 (m, cm, mm, um, km)"}},
    {"unknown_unit",
     "+solver: {block_size: 6 inch}\n",
     {},
     {"4:22: error: solver.block_size: 'inch' is not a unit; expected a length >= 0 (m, cm, mm, um, km)"}},
    {"unit_of_pure_number",
     "+correction: {share: 5 mm}\n",
     {},
     {"4:21: error: correction.share: '5 mm' is a length; expected a number 0 to 1"}},
    {"not_whole",
     "+solver: {max_sweeps: 2.5}\n",
     {},
     {"4:22: error: solver.max_sweeps: '2.5' is not whole; expected an integer 1 to 1000000000"}},
    {"word_for_integer", "+seed: many\n", {}, {"4:7: error: seed: 'many' is not a number; expected an integer >= 0"}},
    {"integer_too_large", "+seed: 1e300\n", {}, {"4:7: error: seed: '1e300' is too large; expected an integer >= 0"}},
    {"negative_seed", "+seed: -1\n", {}, {"4:7: error: seed: '-1' is out of range; expected an integer >= 0"}},
    {"yes",
     "+output: {contacts: yes}\n",
     {},
     {"4:20: error: output.contacts: 'yes' is not taken, write true; expected true or false"}},
    {"off",
     "+output: {contacts: Off}\n",
     {},
     {"4:20: error: output.contacts: 'Off' is not taken, write false; expected true or false"}},
    {"number_for_truth", "+output: {contacts: 1}\n", {}, {"4:20: error: output.contacts: '1'; expected true or false"}},
    {"quoted_truth",
     "+output: {contacts: \"true\"}\n",
     {},
     {"4:20: error: output.contacts: 'true'; expected true or false"}},
    {"choice",
     "+solver: {method: gaus_seidel}\n",
     {},
     {"4:18: error: solver.method: 'gaus_seidel' (did you mean 'gauss_seidel'?); expected one of "
      "conjugate_gauss_seidel, gauss_seidel"}},
    {"choice_in_list",
     "+output: {fields: [velocity, color]}\n",
     {},
     {"4:29: error: output.fields[1]: 'color'; expected one of velocity, spin, material, mass, orientation"}},
    {"word_for_list",
     "+output: {fields: spin}\n",
     {},
     {"4:18: error: output.fields: 'spin'; expected a list out of velocity, spin, material, mass, orientation"}},
    {"two_components",
     "+gravity: [0, -9.81]\n",
     {},
     {"4:10: error: gravity: a list of 2; expected a list of three accelerations (m/s2)"}},
    {"number_for_vector",
     "+gravity: -9.81\n",
     {},
     {"4:10: error: gravity: '-9.81'; expected a list of three accelerations (m/s2)"}},
    {"bad_component",
     "+origin: [0, 1 kg, x]\n",
     {},
     {"4:13: error: origin[1]: '1 kg' is a mass; expected a length (m, cm, mm, um, km)",
      "4:19: error: origin[2]: 'x' is not a number; expected a length (m, cm, mm, um, km)"}},
    {"zero_direction",
     "+walls:\n- {shape: plane, name: a, material: glass, point: [0, 0, 0], normal: [0, 0, 0]}\n",
     {},
     {"5:70: error: walls[0].normal: a vector without length; expected a direction: a list of three numbers, not all "
      "0"}},
    {"cells",
     "+bodies:\n- {generator: lattice, material: glass, size: {distribution: fixed, diameter: 1}, corner: [0, 0, "
     "0], pitch: 1, cells: [1, 0]}\n",
     {},
     {"5:119: error: bodies[0].cells: a list of 2; expected a list of 3 integers 1 to 1000000000"}},
    {"row_too_short",
     "+gravity_table: [[0, 0, 0, 0], [1, 2]]\n",
     {},
     {"4:31: error: gravity_table[1]: a list of 2; expected a row [time, x, y, z]"}},
    {"empty_table",
     "+gravity_table: []\n",
     {},
     {"4:16: error: gravity_table: an empty list; expected a list of rows [time, x, y, z]"}},
    {"number_for_text",
     "+title: 2024\n",
     {},
     {"4:8: error: title: '2024' is no text without quotes; expected a text: write \"2024\""}},
    {"list_for_text", "+title: [a]\n", {}, {"4:8: error: title: a list; expected a text"}},
    {"bad_name",
     "+outlets:\n- {name: a b, region: {shape: sphere, centre: [0, 0, 0], radius: 1}}\n",
     {},
     {"5:10: error: outlets[0].name: 'a b' cannot be a name; expected letters, digits, '_' and '-'"}},
    {"box_upside_down",
     "+outlets:\n- {name: a, region: {shape: box, lower: [0, 0, 0], upper: [1, 1, -1]}}\n",
     {},
     {"5:59: error: outlets[0].region.upper[2] is -1, which is not above outlets[0].region.lower[2], 0"}},
    {"goes_before_it_appears",
     "+walls:\n- {shape: plane, name: a, material: glass, point: [0, 0, 0], normal: [0, 0, 1], "
     "appears: 2, goes: 1 s}\n",
     {},
     {"5:99: error: walls[0].goes is 1, which is not above walls[0].appears, 2"}},
    {"below_a_default",
     "+solver: {max_sweeps: 1}\n",
     {},
     {"4:22: error: solver.max_sweeps is 1, which is below solver.min_sweeps, 2"}},
    {"same_name_twice",
     "+outlets:\n- {name: a, region: {shape: sphere, centre: [0, 0, 0], radius: 1}}\n"
     "- {name: a, region: {shape: sphere, centre: [0, 0, 0], radius: 1}}\n",
     {},
     {"6:10: error: outlets[1].name: 'a' is taken already, by outlets[0].name on line 5"}},
    {"no_such_material",
     "+bodies:\n- {generator: sphere, material: glas, position: [0, 0, 0], radius: 1}\n",
     {},
     {"5:33: error: bodies[0].material: 'glas' is not one of the materials (did you mean 'glass'?); there are glass"}},
    {"no_such_material_in_pair",
     "+pairs: [{materials: [glass, steel]}]\n",
     {},
     {"4:29: error: pairs[0].materials[1]: 'steel' is not one of the materials; there are glass"}},
    {"pair_of_three",
     "+pairs: [{materials: [glass, glass, glass]}]\n",
     {},
     {"4:21: error: pairs[0].materials: a list of 3; expected a list of 2 names of materials"}},
    {"no_such_wall",
     "+measures: [{measure: wall_force, name: f, wall: floor}]\n",
     {},
     {"4:49: error: measures[0].wall: 'floor' is not one of the walls; none is given"}},
};

const std::vector<Wrong> kShapes{
    {"shape_without_kind",
     "+shapes:\n- {name: a}\n",
     {},
     {"5:3: error: shapes[0]: 'kind' is missing; expected one of box, prism, tetrahedron, octahedron, dodecahedron, "
      "icosahedron, eota, rock, hull, file"}},
    {"unknown_kind",
     "+shapes:\n- {name: a, kind: octaedron, edge: 1}\n",
     {},
     {"5:19: error: shapes[0].kind: 'octaedron' (did you mean 'octahedron'?); expected one of box, prism, tetrahedron, "
      "octahedron, dodecahedron, icosahedron, eota, rock, hull, file"}},
    {"shape_without_name",
     "+shapes:\n- {kind: box, size: 1}\n",
     {},
     {"5:3: error: shapes[0] (kind: box) lacks the key 'name': expected a text"}},
    {"two_shapes_of_one_name",
     "+shapes:\n- {name: a, kind: box, size: 1}\n- {name: a, kind: box, size: 2}\n",
     {},
     {"6:10: error: shapes[1].name: 'a' is taken already, by shapes[0].name on line 5"}},
    {"unknown_key_of_a_shape",
     "+shapes:\n- {name: a, kind: prism, sides: 6, radius: 1, hight: 2}\n",
     {},
     {"5:3: error: shapes[0] (kind: prism) lacks the key 'height': expected a length > 0 (m, cm, mm, um, km)",
      "5:47: error: 'hight' is not a key of shapes[0] (kind: prism) (did you mean 'height'?); its keys are kind, name, "
      "sides, radius, height, diameter, volume"}},
    {"too_few_sides",
     "+shapes:\n- {name: a, kind: prism, sides: 2, radius: 1, height: 2}\n",
     {},
     {"5:33: error: shapes[0].sides: '2' is out of range; expected an integer 3 to 1000"}},
    {"no_size",
     "+shapes:\n- {name: a, kind: icosahedron}\n",
     {},
     {"5:3: error: shapes[0] (kind: icosahedron) lacks one of the keys edge, diameter, volume"}},
    {"two_sizes",
     "+shapes:\n- {name: a, kind: rock, length: 1, volume: 2 L}\n",
     {},
     {"5:36: error: 'length' and 'volume' of shapes[0] (kind: rock) exclude each other; keep one"}},
    {"two_scales",
     "+shapes:\n- {name: a, kind: file, path: a.off, scale: 2, diameter: 1}\n",
     {},
     {"5:48: error: 'scale' and 'diameter' of shapes[0] (kind: file) exclude each other; keep one"}},
    {"volume_in_metres",
     "+shapes:\n- {name: a, kind: octahedron, volume: 2 m}\n",
     {},
     {"5:39: error: shapes[0].volume: '2 m' is a length; expected a volume > 0 (m3, L, cm3, mm3)"}},
    {"elongation_above_1",
     "+shapes:\n- {name: a, kind: rock, length: 1, elongation: 1.5}\n",
     {},
     {"5:48: error: shapes[0].elongation: '1.5' is out of range; expected a number > 0 and <= 1"}},
    {"unknown_eota",
     "+shapes:\n- {name: a, kind: eota, length: 1, form: EOTA112}\n",
     {},
     {"5:42: error: shapes[0].form: 'EOTA112' (did you mean 'EOTA111'?); expected one of EOTA111, EOTA211, EOTA221"}},
    {"point_of_two",
     "+shapes:\n- {name: a, kind: hull, points: [[0, 0, 0], [1, 0]]}\n",
     {},
     {"5:45: error: shapes[0].points[1]: a list of 2; expected a row [x, y, z]"}},
    {"no_such_shape",
     "+bodies:\n- {generator: polyhedron, shape: bloc, material: glass, position: [0, 0, 0]}\n",
     {},
     {"5:34: error: bodies[0].shape: 'bloc' is not one of the shapes; none is given"}},
    {"neither_size_nor_shape",
     "+bodies:\n- {generator: lattice, material: glass, corner: [0, 0, 0], pitch: 1, cells: [1, 1, 1]}\n",
     {},
     {"5:3: error: bodies[0] (generator: lattice) lacks one of the keys size, shape"}},
    {"quaternion_of_three",
     "+shapes: [{name: a, kind: box, size: 1}]\nbodies:\n- {generator: polyhedron, shape: a, material: glass, "
     "position: [0, 0, 0], orientation: {quaternion: [1, 0, x]}}\n",
     {},
     {"6:101: error: bodies[0].orientation.quaternion: a list of 3; expected a list of 4 numbers"}},
    {"quaternion_of_words",
     "+shapes: [{name: a, kind: box, size: 1}]\nbodies:\n- {generator: polyhedron, shape: a, material: glass, "
     "position: [0, 0, 0], orientation: {quaternion: [1, 0, x, 0]}}\n",
     {},
     {"6:108: error: bodies[0].orientation.quaternion[2]: 'x' is not a number; expected a number"}},
    {"two_orientations",
     "+shapes: [{name: a, kind: box, size: 1}]\nbodies:\n- {generator: polyhedron, shape: a, material: glass, "
     "position: [0, 0, 0], orientation: {random: true, euler: [0, 0, 0]}}\n",
     {},
     {"6:89: error: 'euler' and 'random' of bodies[0].orientation exclude each other; keep one"}},
    {"voronoi_in_a_ball",
     "+bodies:\n- {generator: voronoi, material: glass, count: 3, region: {shape: sphere, centre: [0, 0, 0], radius: "
     "1}}\n",
     {},
     {"5:67: error: bodies[0].region.shape: 'sphere'; expected one of box"}},
    {"joint_without_spacing",
     "+bodies:\n- {generator: rock_mass, material: glass, points: [[0, 0, 0]], joints: [{dip: 95 deg}]}\n",
     {},
     {"5:73: error: bodies[0].joints[0] lacks the key 'spacing': expected a length > 0 (m, cm, mm, um, km)",
      "5:79: error: bodies[0].joints[0].dip: '95 deg' is out of range; expected an angle 0 to 1.5707963267948966 (rad, "
      "deg)"}},
    {"rock_mass_of_nothing",
     "+bodies:\n- {generator: rock_mass, material: glass}\n",
     {},
     {"5:3: error: bodies[0] (generator: rock_mass) lacks one of the keys region, points"}},
    {"arch_all_round_and_more",
     "+bodies:\n- {generator: arch, material: glass, centre: [0, 0, 0], count: 9, radius: 1, thickness: 0.1, depth: 1, "
     "embrace: 400 deg}\n",
     {},
     {"5:113: error: bodies[0].embrace: '400 deg' is out of range; expected an angle > 0 and <= 6.283185307179586 "
      "(rad, deg)"}},
    {"unknown_bond",
     "+bodies:\n- {generator: wall_of_blocks, material: glass, corner: [0, 0, 0], rows: 2, columns: 2, size: [1, 1, "
     "1], "
     "bond: runing}\n",
     {},
     {"5:111: error: bodies[0].bond: 'runing' (did you mean 'running'?); expected one of running, stack"}},
};

const std::vector<Wrong> kOverrides{
    {"override_value",
     "+",
     {"time.step=abc"},
     {"--set time.step=abc:1:11: error: time.step: 'abc' is not a number; expected a time > 0 (s, ms, us, min, h)"}},
    {"override_unknown_key",
     "+",
     {"correction.swep=3"},
     {"--set correction.swep=3:1:12: error: 'swep' is not a key of correction (did you mean 'sweeps'?); its keys are "
      "enabled, sweeps, share"}},
    {"override_without_value",
     "+",
     {"seed"},
     {"--set seed:1:5: error: expected KEY=VALUE, as in time.step=5e-4; there is no '='"}},
    {"override_with_empty_value", "+", {"seed="}, {"--set seed=:1:6: error: seed: no value; expected an integer >= 0"}},
    {"override_without_key", "+", {"=3"}, {"--set =3:1:1: error: expected the name of a key"}},
    {"override_with_empty_part", "+", {"time..step=3"}, {"--set time..step=3:1:6: error: expected the name of a key"}},
    {"override_with_bad_index",
     "+",
     {"walls[x].name=a"},
     {"--set walls[x].name=a:1:6: error: expected '.name', '[number]' (from 0) or '[+]'"}},
    {"override_beyond_the_list",
     "+gravity: [0, 0, -9.81]\n",
     {"gravity[3]=1"},
     {"--set gravity[3]=1:1:8: error: gravity has 3 items, counted from 0; use [+] to append"}},
    {"override_of_item_of_nothing",
     "+",
     {"gravity[2]=-1.62"},
     {"--set gravity[2]=-1.62:1:8: error: gravity is not given in the scenario, so it has no items; use [+] to "
      "append"}},
    {"override_below_a_value",
     "+",
     {"time.step.size=3"},
     {"--set time.step.size=3:1:11: error: time.step is a value, it has no keys"}},
    {"override_of_list_without_index",
     "+walls: []\n",
     {"walls.name=a"},
     {"--set walls.name=a:1:7: error: walls is a list: expected [number] after it, as in walls[0].name"}},
    {"override_index_of_map", "+", {"time[0]=3"}, {"--set time[0]=3:1:5: error: time is not a list"}},
    {"override_syntax", "+", {"gravity=[0, 0"}, {"--set gravity=[0, 0:1:9: error: this '[' is not closed"}},
    {"override_include",
     "+",
     {"include=a.yaml"},
     {"--set include=a.yaml:1:1: error: 'include' cannot be set here; name the file in the scenario"}},
};

class WrongScenario : public testing::TestWithParam<Wrong> {};

TEST_P(WrongScenario, IsRefusedInTheseWords) {
    const Wrong& wrong = GetParam();
    Diagnostics diagnostics;
    const ReadResult result = read_scenario_text(whole_text(wrong), "s.yaml", wrong.overrides, diagnostics);
    const std::vector<std::string> expected(wrong.errors.begin(), wrong.errors.end());
    EXPECT_EQ(error_lines(diagnostics.report()), expected) << diagnostics.report();
    EXPECT_EQ(result.resolved, "");
}

std::string name_of(const testing::TestParamInfo<Wrong>& info) {
    return info.param.name;
}
INSTANTIATE_TEST_SUITE_P(Syntax, WrongScenario, testing::ValuesIn(kSyntax), name_of);
INSTANTIATE_TEST_SUITE_P(Keys, WrongScenario, testing::ValuesIn(kKeys), name_of);
INSTANTIATE_TEST_SUITE_P(Values, WrongScenario, testing::ValuesIn(kValues), name_of);
INSTANTIATE_TEST_SUITE_P(Shapes, WrongScenario, testing::ValuesIn(kShapes), name_of);
INSTANTIATE_TEST_SUITE_P(Overrides, WrongScenario, testing::ValuesIn(kOverrides), name_of);

}  // namespace
}  // namespace scree::io
