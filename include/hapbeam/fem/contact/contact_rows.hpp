// SPDX-License-Identifier: MIT
// Contacts at any places of a beam on a mesh that stays: rows of its equations, with the forces as unknowns.
//
//   | K  b | | Δx |   | -r |
//   | bᵀ -c| | Δλ | = | -ρ |          b, ρ, c: of the touched elements, whose inner nodes are condensed: touched_element.hpp where elements are exact, split_element.hpp
//
// is solved through one column more for each, L⁻¹b:  (c + bᵀK⁻¹b) Δλ = ρ + bᵀK⁻¹(-r).  An equilibrium is stable where K has as many negative
// pivots as c + bᵀK⁻¹b, which is as large as there are contacts.
// Allocates at construction.  Real-time: all else is noexcept and allocation-free, O(contacts · elements + contacts³).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

#include <hapbeam/body/split_element.hpp>
#include <hapbeam/body/touched_element.hpp>
#include <hapbeam/fem/solver/block_tridiagonal.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam::detail {

/// What an element is to a beam that is touched there.  Elements in space have theirs in touched_rod.hpp.
template <class Element, typename Scalar, int Most, typename = void>
struct TouchedOf {
  using Type = std::conditional_t<has_own_tension<Element>, TouchedElement<Element, Scalar, Most>,
                                  SplitElement<Element, Scalar, Most>>;
};

/// @tparam Most  contacts
template <class Element, typename Scalar, class Assembler, class Friction, int Most>
class ContactRows {
 public:
  using Contact = InnerContact<Scalar, dimension_of<Element>>;
  using Touched = typename TouchedOf<Element, Scalar, Most>::Type;
  using Vector = VectorOf<Scalar, dimension_of<Element>>;
  static constexpr int most = Most, dimension = dimension_of<Element>, unknowns = unknowns_of<Element>();
  /// Whether bodies touch it, with friction; else its places are held.
  static constexpr bool takes_bodies = any_rotation<Element>;
  using Residual = VectorOf<Scalar, 2 * unknowns>;
  using Tangent = Eigen::Matrix<Scalar, 2 * unknowns, 2 * unknowns>;

  explicit ContactRows(int elements) : ContactRows(elements, std::make_index_sequence<Most>()) {}

  int size() const noexcept { return size_; }
  bool any() const noexcept { return size_ > 0; }
  const Contact& operator[](int k) const noexcept { return rows_[k].contact; }
  Friction* friction(int k) const noexcept { return takes_bodies ? rows_[k].friction : nullptr; }
  int element(int k) const noexcept { return rows_[k].element; }
  /// Whether an element is touched.
  bool in(int e) const noexcept {
    bool any = false;
    each_in(e, [&](int) { any = true; });
    return any;
  }

  void clear() noexcept { size_ = 0; }
  /// The same where the beam goes elsewhere.   @param force  of the first one there [N]
  void let_go(Scalar force) noexcept {
    clear();
    reached_ = {force};
  }
  /// @param goal  its reach is where the path ends; its piece, where that is of this element, goes on   @param element  that holds it
  /// @param friction  null: none
  /// @param stays  s, until an equilibrium is found
  void add(const Contact& goal, int element, Friction* friction,
           [[maybe_unused]] bool stays = false) noexcept {
    Row& row = rows_[size_++];
    row.contact = goal, row.element = element, row.friction = friction;
    row.contact.rough = friction != nullptr;
    if constexpr (dimension == 3) row.contact.stays = friction && stays;
    row.contact.enter(element), row.contact.forget_order();
    row.goal = goal.reach, row.centre = row.contact.centre_or_tip(), row.by = 0, row.from = -1;
    starts_known_ = false;
  }
  /// So far along the path.  @param look  (k) looks at contact k as it is
  template <class Look>
  void aim(Scalar t, Look&& look) noexcept {
    const bool starts = t < 1 && !starts_known_;
    for (int k = 0; k < size_; ++k) {
      Row& row = rows_[k];
      Contact& contact = row.contact;
      if (starts) look(k), row.start = contact.normal.dot(contact.displacement());
      contact.seen = false;
      if (contact.kind == Contact::Kind::along) {
        contact.reach = t < 1 ? row.start + t * (row.goal - row.start) : row.goal;
        continue;
      }
      if (starts) row.way = contact.way_to_curve();
      contact.centre_or_tip() = t < 1 ? Vector(row.centre + (1 - t) * row.way) : row.centre;
    }
    starts_known_ = starts_known_ || starts;
  }
  void save() noexcept {
    saved_ = reached_;
    for (int k = 0; k < size_; ++k) rows_[k].saved = rows_[k].contact, rows_[k].saved_in = rows_[k].element;
  }
  void restore() noexcept {
    reached_ = saved_;
    for (int k = 0; k < size_; ++k) {
      Row& row = rows_[k];
      const Scalar reach = row.contact.reach;
      const Vector centre = row.contact.centre_or_tip();
      row.contact = row.saved, row.element = row.saved_in, row.by = 0;
      row.contact.seen = false;
      row.contact.reach = reach, row.contact.centre_or_tip() = centre;
    }
  }
  /// The beam falls, and the forces of before are no longer there.
  void fall() noexcept {
    for (int k = 0; k < size_; ++k) {
      rows_[k].contact.force = 0, rows_[k].contact.seen = false;
      if (friction(k)) friction(k)->fall();
    }
  }
  void forget_friction() noexcept {
    for (int k = 0; k < size_; ++k) rows_[k].friction = nullptr;
  }
  /// What friction stores [J].
  Scalar friction_potential() const noexcept {
    Scalar sum = 0;
    for (int k = 0; k < size_; ++k)
      if (friction(k)) sum += friction(k)->potential();
    return sum;
  }

  /// Places, normals and tangents of contacts as their element lies now.  @param beam  BeamElements
  /// @param set  (N) takes the tension of its longest piece [N]
  template <class Parts, class Set>
  void look(const Parts& beam, int e, Set&& set) noexcept {
    bool seen = true;
    each_in(e, [&](int k) { seen = seen && rows_[k].contact.seen; });
    if (seen) return;
    Touched touched(beam, e);
    each_in(e, [&](int k) { touched.add(rows_[k].contact, k), rows_[k].contact.seen = true; });
    touched.look();
    set(touched.tension());
  }
  /// Brings contacts to where they touch the curve as it lies.
  template <class Parts>
  void seek(const Parts& beam) noexcept {
    for (int k = 0; k < size_; ++k) {
      Row& row = rows_[k];
      row.touched.reset();
      if (row.contact.kind != Contact::Kind::round || !row.contact.moves || !row.contact.seeks) continue;
      Touched::seek(beam, row.element, row.contact, k, row.touched);
      row.contact.seeks = !row.contact.stays;
    }
  }
  /// Where a place has stayed, it goes to where the curve is tangent in the equilibrium that was found.
  /// @param element_at  as of advance()   @param length  of the beam [m]   @return whether that is another equilibrium
  template <class ElementAt>
  bool go_on_to_tangent(ElementAt&& element_at, Scalar length) noexcept {
    constexpr Scalar exact = (std::max)(Scalar(1e-4), 1000 * std::numeric_limits<Scalar>::epsilon());
    bool another = false;
    for (int k = 0; k < size_; ++k) {
      Row& row = rows_[k];
      Contact& contact = row.contact;
      if (!contact.stays) continue;
      const Scalar off = std::abs(contact.off), normal = std::abs(contact.force);
      // Its friction has another moment there, and the gap another size by the square.
      another = another || off * (contact.friction.norm() * contact.reach + 1000 * normal * off) >
                               exact * normal * length * contact.reach;
      contact.s -= contact.off;
      contact.off = 0, contact.seen = false;
      stay_on_beam(row, element_at);
    }
    return another;
  }
  /// Calls use(touched) with a touched element as it lies, and returns what that does.
  template <class Parts, class Use>
  auto as_touched(const Parts& beam, int e, Use&& use) const noexcept {
    Touched touched(beam, e);
    Contact contacts[Most];
    each_in(e, [&](int k) { touched.add(contacts[k] = rows_[k].contact, k); });
    return use(touched);
  }
  /// Its residual.
  template <class Parts>
  Residual residual(const Parts& beam, int e) const noexcept {
    return as_touched(beam, e, [](Touched& touched) {
      Residual r;
      Tangent K;
      (void)touched.condense(r, K, [](int) {});
      return r;
    });
  }

  /// Residual and tangent of a touched element, its contacts included.  @return V [J]
  template <class Parts>
  Scalar touch(const Parts& beam, int e, Residual& r, Tangent& K) noexcept {
    int first = -1, number = 0;
    Touched* touched = nullptr;
    each_in(e, [&](int k) {
      Row& row = rows_[k];
      // What was sought has been added.
      const bool sought = dimension == 3 && first < 0 && row.touched;
      if (first < 0) first = k, touched = sought ? &*row.touched : &row.touched.emplace(beam, e);
      row.first = first, row.number = number++, row.contact.seen = false;
      if (!sought) touched->add(row.contact, k);
    });
    const Scalar energy = touched->condense(r, K, [&](int k) {
      if (friction(k)) friction(k)->look(rows_[k].contact), friction(k)->give(rows_[k].contact);
    });
    each_in(e, [&](int k) {
      Row& row = rows_[k];
      row.b = touched->column(row.number);
      row.residual =
          touched->residual(row.number) + row.contact.ahead - row.contact.force * row.contact.compliance;
    });
    return energy;
  }
  /// Calls change(what each row has of the unknowns of a node, its residual).
  template <class Change>
  void visit_node(int node, Change&& change) noexcept {
    for (int k = 0; k < size_; ++k) {
      Row& row = rows_[k];
      if (node == row.element) change(row.b.template head<unknowns>(), row.residual);
      else if (node == row.element + 1) change(row.b.template tail<unknowns>(), row.residual);
    }
  }
  /// Of an unknown of a node whose increment is known.
  void prescribe(int node, int component, Scalar increment) noexcept {
    visit_node(node, [&](auto&& b, Scalar& residual) {
      residual += b[component] * increment;
      b[component] = 0;
    });
  }
  Status solve(Assembler& assembler) noexcept {
    Status status = assembler.factor();
    Scalar force[Most] = {}, before[Most] = {};
    for (int k = 0; k < size_; ++k) {
      Row& row = rows_[k];
      assembler.forward(row.element, row.b, row.column);
      before[k] = assembler.product(row.column);
      force[k] = row.residual + before[k];
      for (int j = 0; j <= k; ++j) {
        const Row& other = rows_[j];
        stiff_[k][j] = assembler.product(row.column, other.column) -
                       (row.first == other.first ? touched(row).yields(row.number, other.number) : Scalar(0));
      }
      stiff_[k][k] += row.contact.compliance;
    }
    int negative = 0;
    solve_forces(force, negative);
    // At a support nothing moves.
    if (status == Status::ok && size_ == 1 && rows_[0].by == 0 && force[0] != 0) status = Status::singular;
    Scalar change = 0, more = 0;
    energy_ = 0;
    for (int k = 0; k < size_; ++k) {
      const Row& row = rows_[k];
      assembler.add(row.column, -row.by);
      change += row.by * (before[k] + row.residual);
      more += row.by * (row.residual - before[k]);
      if (row.number == 0) {
        change += 2 * touched(row).local_change();
        negative += touched(row).turned();
      }
    }
    assembler.substitute();
    energy_ = assembler.energy() + more;
    foreseen_ = (change - assembler.energy()) / 2;
    negative_ = assembler.negative_pivots() - negative;
    return status == Status::ok && !std::isfinite(energy_) ? Status::non_finite : status;
  }
  /// ΔᵀKΔ of the last solve(), that of the forces included [J].
  Scalar energy() const noexcept { return energy_; }
  int negative_pivots() const noexcept { return negative_; }
  /// After solve(): √(2V), or of several what the weakest force, which has to be exact, too, is worth where the other contacts stay, λ²/(S⁻¹)ₖₖ [√J].
  /// S = c + bᵀK⁻¹b, and an increment Δ changes λ by no more than √(ΔᵀKΔ (S⁻¹)ₖₖ).
  Scalar weight(Scalar size) const noexcept {
    if (size_ < 2) return size;
    Scalar least = std::numeric_limits<Scalar>::infinity();
    for (int k = 0; k < size_; ++k) {
      // Row k of S⁻¹ by its factors.
      Scalar y[Most] = {};
      Scalar stiff = 0;
      y[k] = 1;
      for (int i = k; i < size_; ++i) {
        for (int j = k; j < i; ++j) y[i] -= stiff_[i][j] * y[j];
        if (pivot_[i] != 0) stiff += y[i] * y[i] / std::abs(pivot_[i]);
      }
      const Scalar force = reaction(k);
      if (stiff > 0) least = (std::min)(least, force * force / stiff);
    }
    return std::clamp(std::sqrt(least), least_weight * size, size);
  }
  /// After solve(): the part of a contact's flexibility that is its compliance, 0 to 1, where those before it yield.
  Scalar share(int k) const noexcept { return rows_[k].contact.compliance / pivot_[k]; }
  /// After solve(), of contact k: along the normal of a held place, or toward the centre of what is round [N].
  Scalar reaction(int k) const noexcept {
    const Row& row = rows_[k];
    const Scalar next = row.contact.force + row.by;
    return row.contact.kind == Contact::Kind::round ? -next : next;
  }
  /// To be called after solve() on the way to an equilibrium: the normal forces, which friction feels.
  void feel() noexcept {
    if (size_ == 0) reached_[0] = 0;
    for (int k = 0; k < size_; ++k) {
      reached_[static_cast<std::size_t>(k)] = reaction(k);
      if (friction(k)) friction(k)->feel(-reaction(k));
    }
  }
  /// Of contact k when it was felt last.  It is accurate to what Newton's next increment would change, and stays where a descent is on its way: that of the
  /// last equilibrium [N].
  Scalar reached(int k) const noexcept { return reached_[static_cast<std::size_t>(k)]; }
  /// What contacts add to V at the last look: -λ g - λ² c/2 [J].
  Scalar potential() const noexcept {
    Scalar sum = 0;
    for (int k = 0; k < size_; ++k) {
      const Contact& contact = rows_[k].contact;
      sum -= contact.force * (contact.gap - contact.ahead + contact.force * contact.compliance / 2);
    }
    return sum;
  }
  /// What holds contacts stores [J].
  Scalar held() const noexcept {
    Scalar sum = 0;
    for (int k = 0; k < size_; ++k)
      sum += rows_[k].contact.force * rows_[k].contact.force * rows_[k].contact.compliance;
    return sum / 2;
  }
  /// By how much all of that and V change with the last increment, to third order of it [J].
  Scalar foreseen_change() const noexcept { return foreseen_; }
  /// To be called where the nodes have moved.  @param by  (e) -> increments of both nodes   @param set  (e, N)
  /// @param element_at  (s, e) -> element, e where that holds it as well   @return as of BeamElements::follow() [J]
  template <class By, class Set, class ElementAt>
  Scalar advance(By&& by, Set&& set, ElementAt&& element_at) noexcept {
    Scalar longer = 0;
    for (int k = 0; k < size_; ++k) {
      Row& row = rows_[k];
      if (row.number != 0) continue;
      std::array<Scalar, Most> forces{};
      for (int j = k; j < size_; ++j)
        if (rows_[j].first == k) forces.data()[rows_[j].number] = rows_[j].by;
      set(row.element, touched(row).advance(by(row.element), forces, longer));
    }
    for (int k = 0; k < size_; ++k) {
      Row& row = rows_[k];
      row.by = 0;
      if (takes_bodies && row.contact.kind == Contact::Kind::round) stay_on_beam(row, element_at);
    }
    return longer;
  }

 private:
  static constexpr Scalar close_by = Scalar(1e-4);     // of a length
  static constexpr Scalar least_weight = Scalar(0.1);  // of a contact that may let go
  struct Row {
    explicit Row(int elements) : column(elements) {}
    Contact contact, saved;
    int element = 0, saved_in = 0;
    int from = -1;       ///< element that it has left,
    Scalar crossed = 0;  ///< and where it came from there [m]
    Friction* friction = nullptr;
    Scalar start = 0, goal = 0;  ///< of reach, on the path [m]
    Vector centre = Vector::Zero(),
           way = Vector::Zero();  ///< where the path ends, and from where it begins [m]
    std::optional<Touched> touched;
    int first = 0;   ///< row that has its element
    int number = 0;  ///< in that
    Residual b = Residual::Zero();
    Scalar residual = 0, by = 0;  ///< [m], Δλ [N]
    typename Assembler::Column column;
  };

  /// To be called where a place has moved.
  template <class ElementAt>
  void stay_on_beam(Row& row, ElementAt&& element_at) noexcept {
    Contact& contact = row.contact;
    // Beyond an end its last point is touched, until the centre comes back.
    const Scalar at = std::clamp(contact.s, contact.least, contact.most);
    if (at != contact.s) contact.moves = contact.seen = false;
    contact.s = at;
    const int left = row.element;
    row.element = element_at(at, left);
    if (row.element != left) {
      // Where each side sends it back by little, it lies at the node between them.
      contact.rests = row.element == row.from && std::abs(at - row.crossed) < close_by * contact.most;
      row.from = left, row.crossed = at, contact.seen = false;
    }
    contact.enter(row.element);
  }
  template <std::size_t... K>
  ContactRows(int elements, std::index_sequence<K...>) : rows_{((void)K, Row(elements))...} {}
  Touched& touched(const Row& row) noexcept { return *rows_[row.first].touched; }
  template <class F>
  void each_in(int e, F&& f) const noexcept {
    for (int k = 0; k < Most && k < size_; ++k)  // a compiler sees how few
      if (rows_[k].element == e) f(k);
  }

  /// By LDLᵀ.  Of contacts that are at one place the last ones keep their forces.   @param x  right side   @param negative  in and out: pivots
  void solve_forces(Scalar (&x)[Most], int& negative) noexcept {
    constexpr Scalar nothing = 256 * std::numeric_limits<Scalar>::epsilon();
    auto& l = stiff_;
    auto& pivot = pivot_;
    for (int k = 0; k < size_; ++k) {
      const Scalar whole = l[k][k];
      Scalar rest = whole;
      for (int j = 0; j < k; ++j) {
        Scalar sum = l[k][j];
        for (int i = 0; i < j; ++i) sum -= l[k][i] * l[j][i] * pivot[i];
        const Scalar factor = pivot[j] != 0 ? sum / pivot[j] : Scalar(0);
        l[k][j] = factor;
        rest -= factor * factor * pivot[j];
        x[k] -= factor * x[j];
      }
      pivot[k] = std::abs(rest) > nothing * std::abs(whole) ? rest : Scalar(0);
      if (rest < 0 && pivot[k] != 0) ++negative;
    }
    for (int k = size_ - 1; k >= 0; --k) {
      Scalar sum = pivot[k] != 0 ? x[k] / pivot[k] : Scalar(0);
      if (pivot[k] != 0)
        for (int j = k + 1; j < size_; ++j) sum -= l[j][k] * rows_[j].by;
      rows_[k].by = sum;
    }
  }

  Row rows_[Most];
  std::array<Scalar, std::size_t(Most)> reached_{}, saved_{};  // [N]
  int size_ = 0;
  bool starts_known_ = false;
  Scalar stiff_[Most][Most] = {};  // S, then its factor L
  Scalar pivot_[Most] = {};
  Scalar energy_ = 0, foreseen_ = 0;
  int negative_ = 0;
};

}  // namespace hapbeam::detail
