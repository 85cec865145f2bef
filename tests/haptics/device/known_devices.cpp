// The table of devices, and the page that shows it.
#include <fstream>
#include <sstream>
#include <string>

#include "support/catch.hpp"
#include <hapbeam/haptics/device/known_devices.hpp>
#include <hapbeam/haptics/stability/coupling.hpp>

using namespace hapbeam;
using Catch::Matchers::ContainsSubstring;

namespace {

std::string number(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

}  // namespace

TEST_CASE("each known device is one that a loop can be built for, and stands in the page", "[devices]") {
  std::ifstream file(HAPBEAM_TEST_DATA_DIR "/../../docs/haptics.md");
  std::stringstream page;
  page << file.rdbuf();
  for (const DeviceInfo& d : known_devices()) {
    CAPTURE(d.name);
    CHECK(known_device(d.name).peak_force == d.peak_force);
    CHECK((d.continuous_force > 0 && d.continuous_force <= d.peak_force));
    CHECK((d.max_stiffness > 0 && d.position_resolution > 0 && d.period == 1e-3));
    CHECK((d.friction >= 0 && d.damping >= 0 && d.apparent_mass >= 0 && (d.workspace.array() > 0).all()));
    std::string row = "| " + d.name + " | ";
    for (int i = 0; i < 3; ++i) row += (i ? " × " : "") + number(1e3 * d.workspace[i]);
    row += " | " + number(d.peak_force) + " | " + number(d.continuous_force) + " | " +
           number(d.max_stiffness) + " | " + number(1e6 * d.position_resolution) + " | ";
    CHECK_THAT(page.str(), ContainsSubstring(row));

    const GimbalInfo& g = d.gimbal;
    const std::string torque = g.peak_torque > 0 ? number(g.peak_torque) : g.reads ? "reads" : "none";
    CHECK_THAT(page.str().substr(page.str().find(row)), ContainsSubstring("| " + torque + " |"));
    CHECK((g.peak_torque == 0 || (g.reads && g.continuous_torque > 0 && g.max_stiffness > 0)));
    CHECK_NOTHROW(VirtualCoupling::for_device(d));
  }
  CHECK_THROWS_WITH(known_device("omega"),
                    ContainsSubstring("device 'omega': must be one of Touch, Touch X, "));
}
