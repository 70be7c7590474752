#include "copula/symbolic/expression.hpp"

#include <algorithm>
#include <mutex>
#include <stdexcept>
#include <unordered_map>
#include <unordered_set>

#include "copula/symbolic/node.hpp"

namespace sklar::symbolic {

namespace {

std::size_t combine(std::size_t seed, std::size_t value) {
  return seed ^ (value + 0x9e3779b97f4a7c15ULL + (seed << 12) + (seed >> 4));
}

std::size_t hash_of(const Node& node) {
  std::size_t hash = combine(static_cast<std::size_t>(node.kind), static_cast<std::size_t>(node.function));
  if (node.kind == Kind::number) {
    hash = combine(hash, hash_value(numerator(node.number)));
    hash = combine(hash, hash_value(denominator(node.number)));
  }
  hash = combine(hash, std::hash<std::string>()(node.name));
  for (const Expression& arg : node.args) hash = combine(hash, arg.node().hash);
  return hash;
}

bool same_contents(const Node& a, const Node& b) {
  return a.kind == b.kind && a.function == b.function && a.args == b.args && a.name == b.name && a.number == b.number;
}

bool positive(const Node& node) {
  switch (node.kind) {
    case Kind::number:
      return node.number > 0;
    case Kind::symbol:
      return false;
    case Kind::function:
      return node.function == Function::exp;
    case Kind::product:
    case Kind::sum:
      return std::all_of(node.args.begin(), node.args.end(), known_positive);
    case Kind::power:
      return known_positive(node.args.front());
  }
  return false;
}

std::vector<std::uint64_t> symbols_below(const std::vector<Expression>& args) {
  std::vector<std::uint64_t> ids;
  for (const Expression& arg : args) {
    const std::vector<std::uint64_t>& more = arg.node().symbols;
    std::vector<std::uint64_t> both;
    std::set_union(ids.begin(), ids.end(), more.begin(), more.end(), std::back_inserter(both));
    ids = std::move(both);
  }
  return ids;
}

}  // namespace

/// The table of all nodes alive. It holds them weakly: a node leaves it when the last expression goes.
class Interner {
 public:
  static Interner& instance() {
    static Interner* interner = new Interner;  // never destroyed: expressions of static duration may outlive it
    return *interner;
  }

  Expression find_or_add(Node&& contents) {
    contents.hash = hash_of(contents);
    const std::lock_guard lock(mutex_);
    const auto [first, last] = nodes_.equal_range(contents.hash);
    for (auto entry = first; entry != last; ++entry) {
      if (!same_contents(*entry->second.node, contents)) continue;
      if (auto alive = entry->second.handle.lock()) return Expression(std::move(alive));
    }
    contents.id = ++last_id_;
    contents.positive = positive(contents);
    contents.symbols = contents.kind == Kind::symbol ? std::vector{contents.id} : symbols_below(contents.args);
    const std::shared_ptr<const Node> node(new Node(std::move(contents)), [this](const Node* dead) { remove(dead); });
    nodes_.emplace(node->hash, Entry{node.get(), node});
    return Expression(node);
  }

 private:
  struct Entry {
    const Node* node;
    std::weak_ptr<const Node> handle;
  };

  // The arguments of the node die outside the lock: they may be the last of their kind and come here in turn.
  void remove(const Node* dead) {
    {
      const std::lock_guard lock(mutex_);
      const auto [first, last] = nodes_.equal_range(dead->hash);
      nodes_.erase(std::find_if(first, last, [dead](const auto& entry) { return entry.second.node == dead; }));
    }
    delete dead;
  }

  std::mutex mutex_;
  std::unordered_multimap<std::size_t, Entry> nodes_;
  std::uint64_t last_id_ = 0;
};

Expression make_node(Kind kind, std::vector<Expression> args, Function function) {
  return Interner::instance().find_or_add({kind, function, {}, {}, std::move(args), {}, false, 0, 0});
}

Expression number(const Rational& value) {
  return Interner::instance().find_or_add({Kind::number, Function::exp, value, {}, {}, {}, false, 0, 0});
}

Expression symbol(const std::string& name) {
  return Interner::instance().find_or_add({Kind::symbol, Function::exp, {}, name, {}, {}, false, 0, 0});
}

Expression rational(long numerator, long denominator) {
  if (denominator == 0) throw std::domain_error("division by zero");
  return number(Rational(numerator) / denominator);
}

Expression::Expression(long value) : Expression(number(Rational(value))) {}

Kind Expression::kind() const noexcept {
  return node_->kind;
}
const std::vector<Expression>& Expression::args() const noexcept {
  return node_->args;
}
const std::string& Expression::name() const noexcept {
  return node_->name;
}
Function Expression::function() const noexcept {
  return node_->function;
}
std::uint64_t Expression::id() const noexcept {
  return node_->id;
}
bool Expression::is(Function function) const noexcept {
  return kind() == Kind::function && node_->function == function;
}
bool Expression::depends_on(const Expression& symbol) const noexcept {
  return std::binary_search(node_->symbols.begin(), node_->symbols.end(), symbol.id());
}

namespace {

int compare_values(const Rational& a, const Rational& b) {
  return a < b ? -1 : (b < a ? 1 : 0);
}

int compare_lists(const std::vector<Expression>& a, const std::vector<Expression>& b) {
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    if (const int order = compare(a[i], b[i])) return order;
  }
  return a.size() < b.size() ? -1 : (a.size() > b.size() ? 1 : 0);
}

int compare_same_kind(const Expression& a, const Expression& b) {
  switch (a.kind()) {
    case Kind::number:
      return compare_values(value_of(a), value_of(b));
    case Kind::symbol:
      return a.name().compare(b.name());
    case Kind::function:
      if (a.function() != b.function()) return a.function() < b.function() ? -1 : 1;
      [[fallthrough]];
    default:
      return compare_lists(a.args(), b.args());
  }
}

}  // namespace

// x stands among its powers as x^1. Equal operands are equal pointers, so that only one path is followed to the bottom.
int compare(const Expression& a, const Expression& b) {
  if (a == b) return 0;
  if (a.kind() == Kind::power || b.kind() == Kind::power) {
    const Powered x = split_power(a);
    const Powered y = split_power(b);
    if (const int order = compare(x.base, y.base)) return order;
    return compare(x.exponent, y.exponent);
  }
  if (a.kind() != b.kind()) return a.kind() < b.kind() ? -1 : 1;
  return compare_same_kind(a, b);
}

Powered split_power(const Expression& e) {
  if (e.kind() == Kind::power) return {e.args()[0], e.args()[1]};
  return {e, 1};
}

std::vector<Expression> terms_of(const Expression& e) {
  return e.kind() == Kind::sum ? e.args() : std::vector{e};
}

std::vector<Expression> factors_of(const Expression& e) {
  return e.kind() == Kind::product ? e.args() : std::vector{e};
}

namespace {

/// Until a visit returns false.
template <class Visit>
void visit_once(const Expression& root, Visit visit) {
  std::unordered_set<Expression, ExpressionHash> seen{root};
  std::vector<Expression> open{root};
  while (!open.empty()) {
    const Expression e = open.back();
    open.pop_back();
    if (!visit(e)) return;
    for (const Expression& arg : e.args()) {
      if (seen.insert(arg).second) open.push_back(arg);
    }
  }
}

}  // namespace

std::size_t node_count(const Expression& e, std::size_t most) {
  std::size_t count = 0;
  visit_once(e, [&](const Expression&) { return ++count < most; });
  return count;
}

std::vector<std::string> symbols(const Expression& e) {
  std::vector<std::string> names;
  visit_once(e, [&names](const Expression& node) {
    if (node.kind() == Kind::symbol) names.push_back(node.name());
    return true;
  });
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace sklar::symbolic
