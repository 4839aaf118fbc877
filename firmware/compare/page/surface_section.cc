// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "firmware/compare/page/sections.h"
#include "pipeline/report/drawing.h"
#include "pipeline/report/page.h"
#include "pipeline/report/text.h"

namespace relievo::firmware::compare::sections {
namespace {

using pipeline::report::Drawing;
using pipeline::report::escaped;
using pipeline::report::figure;

std::string facts_of(const Run& run) {
  const SurfaceLook& look = *run.surface;
  std::string facts = figure(look.mesh_ms, 0) + " ms to mesh, " + std::to_string(look.triangles) +
                      " triangles, " +
                      figure(100 * static_cast<double>(look.measured) /
                                 static_cast<double>(std::max<std::size_t>(1, look.vertices)),
                             0) +
                      " % of the vertices measured";
  if (run.model)
    facts += "; interior median " + figure(run.model->interior_median_mm, 3) + " mm, " +
             figure(100 * run.model->complete_half_mm, 1) + " % within 0.5 mm";
  return facts;
}

}  // namespace

std::string surfaces(const Comparison& c, const Runs& runs) {
  std::string out;
  for (const Run* run : runs) {
    if (!run->surface) continue;
    Drawing d({480, 240}, name_of(c, *run) + ": its surface from in front and from the side");
    d.picture({{0, 0}, {240, 240}}, run->surface->front);
    d.picture({{240, 0}, {240, 240}}, run->surface->side);
    out += pipeline::report::figure_of(d.svg(), escaped(name_of(c, *run)), facts_of(*run));
  }
  if (out.empty()) return out;
  return "<h3 class=\"topic\">Surfaces</h3>\n<p class=\"lead\">Each set’s model in plain shading, from in "
         "front and turned by 50°, all at one scale.</p>\n<div class=\"pair\">\n" +
         out + "</div>\n";
}

}  // namespace relievo::firmware::compare::sections
