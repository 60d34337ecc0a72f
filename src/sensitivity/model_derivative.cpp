#include "sensitivity/model_derivative.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "base/rounding.hpp"
#include "contact/friction.hpp"
#include "model/build.hpp"
#include "model/internal_units.hpp"
#include "sensitivity/parameter.hpp"
#include "sensitivity/static_rate.hpp"

namespace signorini::sensitivity {

const Stencil& two_points() {
  static const Stencil s{{1, -1}, {0.5, -0.5}, {0.5, -0.5}};
  return s;
}
const Stencil& six_points() {
  static const Stencil s{{1, -1, 2, -2, 3, -3},
                         {0.75, -0.75, -0.15, 0.15, 1.0 / 60.0, -1.0 / 60.0},
                         {2.0 / 3.0, -2.0 / 3.0, -1.0 / 12.0, 1.0 / 12.0, 0.0, 0.0}};
  return s;
}
const Stencil& one_sided_points() {
  static const Stencil s{{0, 1, 2, 3, 4, 5},
                         {-137.0 / 60.0, 5.0, -5.0, 10.0 / 3.0, -1.25, 0.2},
                         {-25.0 / 12.0, 4.0, -3.0, 4.0 / 3.0, -0.25, 0.0}};
  return s;
}

namespace {

// Smallest number of stored coefficients of a piece, so that each zero coefficient also has a place for its derivative: five,
// as for the integral of a cubic.
constexpr std::size_t min_coefficients = 5;

HistoryRates stored_numbers(const History& history) {
  HistoryRates numbers{history.starts(), history.pieces()};
  for (Piece& piece : numbers.pieces)
    if (piece.coefficients.size() < min_coefficients) piece.coefficients.resize(min_coefficients, 0.0);
  return numbers;
}

ContactRates stored_numbers(const Contact& contact) {
  ContactRates c;
  c.normal = contact.normal;
  c.tangent = contact.tangent;
  c.body_tangent = contact.body_tangent();
  c.gap = contact.gap;
  c.tangential_stiffness = contact.tangential_stiffness.value_or(0.0);
  c.initial_shear = contact.initial_shear;
  c.restitution = contact.restitution;
  c.friction = contact.friction;
  if (const ShearElement* element = contact.sliding_point()) c.shear_stiffness = element->stiffness;
  c.normal_force = stored_numbers(contact.normal_force);
  c.surface_motion = stored_numbers(contact.surface_motion);
  for (const State state : all_states) {
    c.rows[index_of(state)] = contact::rows(contact, {state, 0.0});
    if (state == State::inside && !(contact.normal_stiffness > 0.0)) continue;
    const auto forms = contact::guards(contact, {state, 0.0});
    for (std::size_t i = 0; i < forms.size(); ++i) c.guards[index_of(state)][i] = forms[i].form;
  }
  return c;
}

}  // namespace

void align(const std::vector<ModelDerivative*>& all) {
  std::vector<std::map<int, double>> none;
  for (ModelDerivative* data : all) {
    std::size_t i = 0;
    visit_combinations(*data, [&](Combination& c) {
      if (none.size() == i) none.emplace_back();
      for (const auto& term : c.terms) none[i][term.first] = 0.0;
      ++i;
    });
  }
  for (ModelDerivative* data : all) {
    std::size_t i = 0;
    visit_combinations(*data, [&](Combination& c) {
      std::map<int, double> factors = none[i++];
      for (const auto& [index, factor] : c.terms) factors[index] += factor;
      c.terms.assign(factors.begin(), factors.end());
    });
  }
}

ModelDerivative data_of(const Model& model) {
  ModelDerivative d;
  d.mass = model.mass;
  d.damping = model.damping;
  d.stiffness = model.stiffness;
  for (const Load& load : model.loads) d.loads.push_back({load.direction, stored_numbers(load.history)});
  for (const Contact& contact : model.contacts) d.contacts.push_back(stored_numbers(contact));
  d.u0 = model.u0;
  d.v0 = model.v0;
  return d;
}

std::vector<long> shape_of(const Model& model) {
  std::vector<long> shape{static_cast<long>(model.dofs.size())};
  const auto history = [&](const History& h) {
    for (const Piece& piece : h.pieces())
      shape.push_back(static_cast<long>(std::max(piece.coefficients.size(), min_coefficients)));
    shape.push_back(-1);
  };
  for (const Dof& dof : model.dofs) shape.push_back(dof.massless);
  for (const Load& load : model.loads) history(load.history);
  for (const Contact& c : model.contacts) {
    history(c.normal_force);
    history(c.surface_motion);
    for (const bool has : {c.tangential_stiffness.has_value(), c.sliding_point() != nullptr, c.has_friction(),
                           c.normal_damping > 0.0, c.normal_force_given(), c.takes_impulses()})
      shape.push_back(has);
    for (const FrictionConstant& constant : friction_constants)
      shape.push_back((c.friction.*constant.value).has_value());
  }
  for (const double reaction : model.statics.reactions) shape.push_back(reaction > 0.0);
  return shape;
}

std::vector<double> values_of(ModelDerivative& data) {
  std::vector<double> values;
  visit_all(data, [&](double& x) { values.push_back(x); });
  return values;
}

std::vector<double> sizes_of(ModelDerivative data) {
  visit_combinations(data, [](Combination& c) {
    double greatest = 0.0;
    for (const auto& term : c.terms) greatest = std::max(greatest, std::abs(term.second));
    for (auto& term : c.terms) term.second = greatest;
  });
  std::vector<double> sizes = values_of(data);
  for (double& size : sizes) size = std::abs(size);
  return sizes;
}

namespace {

constexpr double first_step = 1.0 / 512.0;  // step h / size of the key
constexpr double shorter = 1.0 / 16.0;
constexpr int max_attempts = 3;
// Largest relative difference of both stencils for smooth data. Chosen value: at the first step the fourth-order stencil has
// an error of 1e-10 for data like 1/p or sqrt(p), while a kink within the stencil gives a difference of a tenth.
constexpr double agreement = 1e-6;
constexpr double rounding_of_data = 4096.0 * rounding::eps;
// Rounding error of data that come from solves (equilibria, and matrices that contain the lowest frequency), relative to the
// largest of the data. Chosen value; the equilibrium of the pipeline scene is accurate to 1e-11.
constexpr double rounding_of_solves = 1e-8;

class Differences {
 public:
  Differences(const SceneReader& read, const Model& model, const std::string& path, double value,
              bool start_follows)
      : read_(read),
        model_(model),
        path_(path),
        value_(value),
        start_is_static_(start_follows),
        base_(data_of(model)),
        shape_(shape_of(model)) {}

  /// Derivative with the step h; nullopt: the data are not smooth, or the scene is refused near the value.
  std::optional<ModelDerivative> at(double h) {
    step_ = h;
    moved_.clear();
    refusal_.reset();
    try {
      take(two_points());
      if (is_linear()) return combined(two_points());
      take(six_points());
      if (agree(six_points())) return combined(six_points());
      return std::nullopt;
    } catch (const Error& error) {
      refusal_ = error.what();
    }
    for (const double side : {1.0, -1.0}) {
      moved_.clear();
      step_ = side * h;
      try {
        take(one_sided_points());
      } catch (const Error&) {
        continue;
      }
      if (!agree(one_sided_points())) continue;
      ModelDerivative d = combined(one_sided_points());
      d.one_sided = true;
      return d;
    }
    return std::nullopt;
  }

  /// Reason why the scene is refused at keys near the value; nullopt: it is accepted.
  [[nodiscard]] const std::optional<std::string>& refusal() const { return refusal_; }

 private:
  struct Moved {
    int point = 0;
    ModelDerivative data;
    std::vector<double> values;
  };

  void take(const Stencil& stencil) {
    for (const int point : stencil.points) {
      if (std::any_of(moved_.begin(), moved_.end(), [&](const Moved& m) { return m.point == point; }))
        continue;
      const Scene scene = read_({set_to(path_, value_ + point * step_)});
      Model model =
          model::rescaled(model::build_without_warnings(scene), scene::inverse(model_.internal_units));
      check_ties(model);
      add_weight_load(model_, model);
      if (shape_of(model) != shape_ || !same_coordinates(model))
        throw SceneError({}, path_, "the structure of the model changes near the value of this key");
      moved_.push_back({point, data_of(model), {}});
    }
    std::vector<ModelDerivative*> all{&base_};
    for (Moved& m : moved_) all.push_back(&m.data);
    align(all);
    for (Moved& m : moved_) m.values = values_of(m.data);
  }

  /// Refuses parameters that change the rule by which nodes follow a rigid body, because derivatives of that rule are not
  /// implemented.
  void check_ties(const Model& model) const {
    if (!model_.ties || !model.ties) return;
    if (!model_.ties->given.empty())
      throw SceneError(
          {}, path_,
          "a support moves a rigid body: derivatives of the motions of its nodes are not available");
    if (SparseMatrix(model.ties->rows - model_.ties->rows).norm() != 0.0)
      throw SceneError({}, path_,
                       "the key moves nodes of a rigid body relative to its centre: derivatives of the "
                       "motions of these nodes are not available");
  }

  /// True if the unknowns of both models are the same. Amplitudes of shapes that depend on the parameter are not the same
  /// unknowns.
  [[nodiscard]] bool same_coordinates(const Model& model) const {
    if (model_.reduction) return model.reduction && model.reduction->shapes == model_.reduction->shapes;
    if (model_.basis) return model.basis && SparseMatrix(*model.basis - *model_.basis).norm() == 0.0;
    return !model.reduction && !model.basis;
  }

  [[nodiscard]] const Moved& at_point(int point) const {
    return *std::find_if(moved_.begin(), moved_.end(), [&](const Moved& m) { return m.point == point; });
  }

  /// Number of values to compare: all, or all before u0 and v0 if u0 and v0 follow from the other data.
  [[nodiscard]] std::size_t judged(std::size_t count) const {
    return start_is_static_ ? count - 2 * static_cast<std::size_t>(model_.size()) : count;
  }
  static bool is_straight(double a, double b, double c) {
    return std::abs(a - 2.0 * b + c) <= 8.0 * rounding::eps * (std::abs(a) + 2.0 * std::abs(b) + std::abs(c));
  }
  static bool is_straight(const SparseMatrix& a, const SparseMatrix& b, const SparseMatrix& c) {
    const SparseMatrix bend = a - 2.0 * b + c;
    const SparseMatrix size = a.cwiseAbs() + 2.0 * b.cwiseAbs() + c.cwiseAbs();
    for (int j = 0; j < bend.outerSize(); ++j)
      for (SparseMatrix::InnerIterator it(bend, j); it; ++it)
        if (std::abs(it.value()) > 8.0 * rounding::eps * size.coeff(it.row(), j)) return false;
    return true;
  }
  [[nodiscard]] bool is_linear() {
    const Moved &up = at_point(1), &down = at_point(-1);
    const std::vector<double> here = values_of(base_);
    for (std::size_t i = 0; i < judged(here.size()); ++i)
      if (!is_straight(up.values[i], here[i], down.values[i])) return false;
    return is_straight(up.data.mass, base_.mass, down.data.mass) &&
           is_straight(up.data.damping, base_.damping, down.data.damping) &&
           is_straight(up.data.stiffness, base_.stiffness, down.data.stiffness);
  }

  /// True if both weights of the stencil give the same derivative of every number, within rounding.
  [[nodiscard]] bool agree(const Stencil& stencil) const {
    const std::size_t count = moved_.front().values.size();
    const std::vector<double> least = sizes_of(base_);
    const std::size_t states = 2 * static_cast<std::size_t>(model_.size());  // u0 and v0 are the last values
    const double motion = std::max(base_.u0.cwiseAbs().maxCoeff(), base_.v0.cwiseAbs().maxCoeff());
    for (std::size_t i = 0; i < judged(count); ++i) {
      double better = 0.0, check = 0.0, size = least[i];
      for (std::size_t k = 0; k < stencil.points.size(); ++k) {
        const double x = at_point(stencil.points[k]).values[i];
        better += stencil.weights[k] * x;
        check += stencil.check[k] * x;
        size = std::max(size, std::abs(x));
      }
      const double rounding = i + states < count ? rounding_of_data * size : rounding_of_solves * motion;
      if (std::abs(better - check) > agreement * std::abs(better) + rounding) return false;
    }
    for (const auto matrix :
         {&ModelDerivative::mass, &ModelDerivative::damping, &ModelDerivative::stiffness}) {
      SparseMatrix better(model_.size(), model_.size()), check = better;
      double size = 0.0;
      for (std::size_t k = 0; k < stencil.points.size(); ++k) {
        const SparseMatrix& x = at_point(stencil.points[k]).data.*matrix;
        better += SparseMatrix(stencil.weights[k] * x);
        check += SparseMatrix(stencil.check[k] * x);
        size = std::max(size, x.norm());
      }
      if (SparseMatrix(better - check).norm() > agreement * better.norm() + rounding_of_solves * size)
        return false;
    }
    return true;
  }

  /// Removes entries that contain only rounding errors, because the data do not depend on the key.
  static SparseMatrix without_rounding(SparseMatrix a, const SparseMatrix& size, double step) {
    a.prune([&](Eigen::Index row, Eigen::Index column, double value) {
      return std::abs(value) > 4.0 * rounding::eps / std::abs(step) * std::abs(size.coeff(row, column));
    });
    return a;
  }

  [[nodiscard]] ModelDerivative combined(const Stencil& stencil) const {
    ModelDerivative d = base_;
    std::vector<double> sums(moved_.front().values.size(), 0.0);
    SparseMatrix zero(model_.size(), model_.size());
    d.mass = d.damping = d.stiffness = zero;
    for (std::size_t k = 0; k < stencil.points.size(); ++k) {
      const Moved& m = at_point(stencil.points[k]);
      const double weight = stencil.weights[k] / step_;
      for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += weight * m.values[i];
      for (const auto matrix :
           {&ModelDerivative::mass, &ModelDerivative::damping, &ModelDerivative::stiffness})
        (d.*matrix) += SparseMatrix(weight * (m.data.*matrix));
    }
    std::size_t i = 0;
    visit_all(d, [&](double& x) {
      // The sum of the weights is zero, so constant data give only a rounding error.
      const double size = std::abs(x), sum = sums[i++];
      x = std::abs(sum) > 16.0 * rounding::eps / std::abs(step_) * size ? sum : 0.0;
    });
    for (const auto matrix : {&ModelDerivative::mass, &ModelDerivative::damping, &ModelDerivative::stiffness})
      d.*matrix = without_rounding(d.*matrix, base_.*matrix, step_);
    const auto drop_constant = [](HistoryRates& h) {
      bool any = false;
      visit_rates(h, [&](double& x) { any = any || x != 0.0; });
      if (!any) h = {};
    };
    for (LoadRates& load : d.loads) drop_constant(load.history);
    for (ContactRates& c : d.contacts) {
      drop_constant(c.normal_force);
      drop_constant(c.surface_motion);
    }
    d.step = step_;
    return d;
  }

  const SceneReader& read_;
  const Model& model_;
  const std::string& path_;
  double value_, step_ = 0.0;
  bool start_is_static_;  // true: u0 is computed from the other data (static_rate.hpp)
  ModelDerivative base_;
  std::vector<long> shape_;
  std::vector<Moved> moved_;
  std::optional<std::string> refusal_;
};

}  // namespace

void add_weight_load(const Model& from, Model& model) {
  const auto weighs = [](const Model& m) {
    return !m.loads.empty() && m.loads.front().kind == LoadKind::weight;
  };
  if (!weighs(from) || weighs(model)) return;
  model.loads.insert(model.loads.begin(), from.loads.front());
  model.loads.front().direction = {};
}

ModelDerivative derivative(const SceneReader& read, const Model& model, const std::string& path, double value,
                           double size) {
  std::string why = "the data of the model do not depend smoothly on this key at the present value";
  const bool follows = model.static_start && !model.statics.frictional;
  for (const bool start_follows : {true, false}) {
    if (start_follows && !follows) continue;
    Differences differences(read, model, path, value, start_follows);
    double h = first_step * size;
    for (int attempt = 0; attempt < max_attempts; ++attempt, h *= shorter) {
      auto d = differences.at(h);
      if (!d) continue;
      if (!start_follows) return *d;
      auto w = static_rate(model, *d);
      if (!w) break;
      d->u0 = std::move(*w);
      return *d;
    }
    if (differences.refusal()) why = "the key cannot be varied: " + *differences.refusal();
  }
  throw UsageError(fmt::format("--parameter {}: {}", path, why));
}

}  // namespace signorini::sensitivity
