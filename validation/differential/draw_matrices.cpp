#include "differential/families.hpp"
#include "differential/matrix_forms.hpp"
#include "differential/scene_text.hpp"

namespace signorini::differential {
std::string matrices_scene(Random& draw) {
  const bool floor = draw.chance(0.3);
  const int half = draw.integer(1, 3);
  const auto n = static_cast<std::size_t>(floor ? 2 * half : draw.integer(2, 6));
  const auto count = static_cast<std::size_t>(draw.integer(1, std::min(static_cast<int>(n) / 2, 3)));
  const double t_end = draw.one_of({0.5, 1.0, 2.0});
  const Matrix mass = mass_matrix(draw, n);
  const auto rank = static_cast<std::size_t>(draw.integer(0, static_cast<int>(n)));
  const Matrix stiffness = gram(draw, n, rank, draw.one_of({1.0, 10.0, 100.0, 1000.0}));
  const Matrix damping = damping_matrix(draw, mass, stiffness);

  std::string contacts, loads;
  Form press(n, 0.0);  // pushes every contact closed
  for (std::size_t k = 0; k < count; ++k) {
    const std::string law = draw.one_of<const char*>({"rigid", "rigid", "compliant", "slider"});
    const Form normal = floor ? unit(n, 2 * k + 1) : normal_form(draw, n, k);
    const Form tangent = floor ? unit(n, 2 * k) : tangent_form(draw, mass, normal, k);
    Keys contact = Keys().name("name", fmt::format("c{}", k)).name("law", law).set("tangent", form(tangent));
    if (law != "slider") {
      contact.set("normal", form(normal)).set("gap", draw.one_of({0.0, 0.0, draw.rounded(0.001, 0.3, 3)}));
      const double force = draw.one_of({1.0, 5.0, 10.0});
      for (std::size_t i = 0; i < n; ++i) press[i] = rounded(press[i] - force * normal[i], 3);
    }
    contacts += table("[[contacts]]", contact.add(contact_laws(draw, {law, 5.0, 1e4, n <= 4})));
  }
  if (greatest(press) > 0.0)
    loads += table("[[loads]]", Keys().set("direction", form(press)).set("amplitude", 1.0));
  for (int i = draw.integer(0, 2); i > 0; --i) {
    Form d = sparse_form(draw, n);
    if (greatest(d) == 0.0) d[0] = 1.0;
    loads += table("[[loads]]", Keys().set("direction", form(d)).add(load_course(draw, 30.0, t_end)));
  }
  Form v(n, 0.0);
  if (draw.chance(0.6))
    for (double& x : v) x = draw.rounded(-1.0, 1.0, 2);
  const std::string initial = Keys().set("u", list(Form(n, 0.0))).set("v", list(v)).braced();
  return run_table(t_end) + Keys().set("initial", initial).lines() +
         table(
             "[matrices]",
             Keys().set("mass", rows(mass)).set("stiffness", rows(stiffness)).set("damping", rows(damping))) +
         contacts + loads;
}

}  // namespace signorini::differential
