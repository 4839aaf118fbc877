// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/recognition/recognition_page.h"

#include <cmath>
#include <functional>

#include "pipeline/report/page.h"
#include "tests/bench/recognition/score_figures.h"

namespace relievo::bench {
namespace {

using pipeline::report::escaped;
using pipeline::report::figure;

using Which = std::function<bool(const Score&, const Person& probe, const Person& gallery)>;

Group group(const Proof& proof, const std::string& name, const Which& which) {
  std::vector<Score> chosen;
  for (const Score& s : proof.scores)
    if (which(s, proof.people[static_cast<std::size_t>(s.probe_person)],
              proof.people[static_cast<std::size_t>(s.gallery)]))
      chosen.push_back(s);
  return {name, judge(chosen)};
}

std::string percent(double share, int decimals) { return figure(100 * share, decimals) + " %"; }

std::string tile(const std::string& name, const std::string& value, const std::string& words) {
  return "<div><h3>" + name + "</h3><p class=\"large\">" + value + "</p><p>" + words + "</p></div>";
}

std::string tiles(const Verdict& v) {
  return "<div class=\"tiles\">" +
         tile("Rank 1", percent(static_cast<double>(v.right_first) / std::max(1, v.probes), 2),
              std::to_string(v.right_first) + " of " + std::to_string(v.probes) +
                  " probes: the nearest enrolled person is the right one") +
         tile("Equal error rate", percent(v.equal_error, 2), "at " + figure(v.equal_error_mm, 3) + " mm") +
         tile("d&#8242;", figure(v.d_prime, 2), "between the two distributions, of the logarithm") +
         tile("Falsely rejected", percent(v.non_match_at_thousandth, 2),
              "where 1 in 1000 others is falsely accepted") +
         tile("Comparisons", std::to_string(v.same + v.different),
              std::to_string(v.same) + " same, " + std::to_string(v.different) + " different, " +
                  std::to_string(v.not_compared) + " impossible") +
         "</div>";
}

std::string table(const std::vector<Group>& groups) {
  std::string rows;
  for (const Group& g : groups) {
    const Verdict& v = g.verdict;
    if (v.probes == 0) continue;
    const auto cell = [](const std::string& text) { return "<td class=\"value\">" + text + "</td>"; };
    rows += "<tr><th>" + escaped(g.name) + "</th>" + cell(std::to_string(v.probes)) +
            cell(percent(static_cast<double>(v.right_first) / v.probes, 2)) +
            cell(percent(v.equal_error, 2)) + cell(figure(v.d_prime, 2)) + cell(figure(v.median_same_mm, 3)) +
            cell(figure(v.greatest_same_mm, 3)) + cell(figure(v.least_different_mm, 3)) +
            cell(figure(v.median_different_mm, 3)) + "</tr>";
  }
  return "<table class=\"numbers\"><thead><tr><th>probes</th><th class=\"value\">count</th><th class=\"value\">rank 1</th>"
         "<th class=\"value\">equal error</th><th class=\"value\">d&#8242;</th><th class=\"value\">same, median mm</th>"
         "<th class=\"value\">same, greatest</th><th class=\"value\">different, least</th><th class=\"value\">different, median</th></tr></thead><tbody>" +
         rows + "</tbody></table>";
}

std::string failures(const Proof& proof) {
  if (proof.failures.empty()) return "<p>Every visit was reconstructed.</p>";
  std::string out = "<ul>";
  for (const Failure& f : proof.failures) out += "<li>" + escaped(f.visit) + ": " + escaped(f.why) + "</li>";
  return out + "</ul>";
}

std::string facts(const Proof& proof, int& own) {
  own = 0;
  for (const Person& p : proof.people) own += p.maker == Maker::Own ? 1 : 0;
  return std::to_string(own) + " identities of our own head, " +
         std::to_string(static_cast<int>(proof.people.size()) - own) + " of the other maker";
}

}  // namespace

std::vector<Group> groups_of(const Proof& proof) {
  std::vector<Group> out;
  const auto turned = [&](const Score& s, const Person& p) {
    return std::abs(p.probes[static_cast<std::size_t>(s.probe)].yaw_deg);
  };
  out.push_back(group(proof, "all", [](auto&&...) { return true; }));
  out.push_back(
      group(proof, "our own head, against our own", [](const Score&, const Person& p, const Person& g) {
        return p.maker == Maker::Own && g.maker == Maker::Own;
      }));
  out.push_back(group(proof, "the other maker's, against the other maker's",
                      [](const Score&, const Person& p, const Person& g) {
                        return p.maker == Maker::Other && g.maker == Maker::Other;
                      }));
  out.push_back(group(proof, "turned by less than 15 degrees",
                      [&](const Score& s, const Person& p, const Person&) { return turned(s, p) < 15; }));
  out.push_back(
      group(proof, "turned by 13 to 23 degrees", [&](const Score& s, const Person& p, const Person&) {
        return turned(s, p) > 13 - 1e-9 && turned(s, p) < 25;
      }));
  out.push_back(group(proof, "turned by 30 degrees",
                      [&](const Score& s, const Person& p, const Person&) { return turned(s, p) > 25; }));
  out.push_back(group(proof, "smiling or squinting", [](const Score& s, const Person& p, const Person&) {
    return p.probes[static_cast<std::size_t>(s.probe)].smile > 0;
  }));
  return out;
}

std::string page_of(const Proof& proof) {
  namespace report = pipeline::report;
  const std::vector<Group> groups = groups_of(proof);
  int own = 0;
  const std::string who = facts(proof, own);
  std::string body =
      report::heading("Relievo", "Recognition proof",
                      {who, std::to_string(kProbes) + " probes each, turned by up to 30 degrees"});
  body += "<section>" + tiles(groups.front().verdict) + "</section>";
  body +=
      "<section><h2>Same and different persons</h2><p class=\"lead\">Each probe is compared with every enrolled person. The score is what is "
      "left between the two measured surfaces (nose, brow, forehead, cheekbones) once one is laid on the other: trimmed, symmetric, in "
      "millimetres. Everything went the whole way: two pictures, rectification, matching, reconstruction, mesh, head frame.</p>" +
      report::side_by_side(
          report::figure_of(
              distribution_figure(proof.scores), "Distributions",
              "Share of the comparisons of a kind that fall into a bar; the distance on a logarithmic scale."),
          report::figure_of(
              rates_figure(proof.scores), "Error rates",
              "Different persons accepted, and the same person rejected, by where the line is drawn.")) +
      "</section><section><h2>By kind</h2>" + table(groups) +
      "</section><section><h2>Who could not be compared</h2>" + failures(proof) + "</section>";
  return report::page("Recognition proof", score_figures_style(), body);
}

}  // namespace relievo::bench
