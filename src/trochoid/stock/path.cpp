#include <trochoid/stock/path.h>

#include <trochoid/base/units.h>

#include <cmath>
#include <limits>

namespace trochoid::stock {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
/// Ends of moves so far beside the line of their run still are on it [m].
constexpr double beside = 1e-9;

bool known(const Point& p) noexcept {
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

double distance(const Point& a, const Point& b) noexcept {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// Distance of c from the line through a and b, infinite where c is not ahead of b.
double off_line(const Point& a, const Point& b, const Point& c) noexcept {
  const double l = distance(a, b);
  double along = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    along += (b[i] - a[i]) * (c[i] - a[i]) / l;
  }
  if (!(along >= l)) {
    return std::numeric_limits<double>::infinity();
  }
  double square = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double rest = c[i] - a[i] - (b[i] - a[i]) / l * along;
    square += rest * rest;
  }
  return std::sqrt(square);
}

/// Lays moves one after the other.
class Layer {
 public:
  Layer(std::size_t moves, double rapid_feed) : rapid_feed_(rapid_feed) {
    out_.begins.assign(moves, unknown);
    out_.piece_of.assign(moves, 0);
  }

  void add(const program::Move& move, std::uint32_t index) {
    const bool rests = move.kind == program::MoveKind::dwell;
    if (rests || !known(at_) || !known(move.end)) {
      wait(rests || move.feed > 0 ? move.time : 0.0, move.spindle);
      if (!rests) {
        at_ = move.end;
      }
      return;
    }
    Piece piece = piece_of(move);
    piece.first = piece.last = index;
    if (!(piece.length > 0)) {
      return;
    }
    pass(piece);
    if (continues(piece)) {
      Piece& run = out_.pieces.back();
      out_.begins[index] = run.length;
      run.to = piece.to;
      run.length = distance(run.from, run.to);
      run.horizontal = std::hypot(run.to[0] - run.from[0], run.to[1] - run.from[1]);
      run.turns_to = piece.turns_to;
      run.time_to = piece.time_to;
      run.last = index;
    } else {
      out_.begins[index] = 0.0;
      out_.pieces.push_back(piece);
    }
    out_.piece_of[index] = static_cast<std::uint32_t>(out_.pieces.size() - 1);
    at_ = move.end;
  }

  Path finish() {
    out_.time = time_;
    out_.turns = turns_;
    return std::move(out_);
  }

 private:
  void wait(double time, double spindle) {
    time_ += time;
    turns_ += time * spindle / unit::turn;
  }

  [[nodiscard]] Piece piece_of(const program::Move& move) const {
    Piece piece{.from = at_,
                .to = move.end,
                .feed = move.kind == program::MoveKind::rapid ? 0.0 : move.feed,
                .spindle = move.spindle,
                .tool = move.tool};
    const double dz = piece.to[2] - piece.from[2];
    piece.horizontal =
        std::hypot(piece.to[0] - piece.from[0], piece.to[1] - piece.from[1]);
    if (move.kind == program::MoveKind::arc) {
      piece.center = move.center;
      const double x = at_[0] - move.center[0];
      const double y = at_[1] - move.center[1];
      piece.radius = std::hypot(x, y);
      piece.start = std::atan2(y, x);
      piece.turn = move.turn;
      piece.horizontal = piece.radius * std::abs(move.turn);
    }
    piece.length = std::hypot(piece.horizontal, dz);
    return piece;
  }

  /// Time and turns of a piece.
  void pass(Piece& piece) {
    const double feed = piece.feed > 0 ? piece.feed : rapid_feed_;
    piece.time_from = time_;
    piece.turns_from = turns_;
    wait(piece.length / feed, piece.spindle);  // N-1
    piece.time_to = time_;
    piece.turns_to = turns_;
  }

  [[nodiscard]] bool continues(const Piece& piece) const {
    if (out_.pieces.empty()) {
      return false;
    }
    const Piece& run = out_.pieces.back();
    return run.last + 1 == piece.first && !run.arc() && !piece.arc() &&
           run.tool == piece.tool && run.feed == piece.feed &&
           run.spindle == piece.spindle &&
           off_line(run.from, run.to, piece.to) < beside;
  }

  double rapid_feed_;
  Path out_;
  Point at_{unknown, unknown, unknown};
  double time_ = 0.0;
  double turns_ = 0.0;
};

}  // namespace

Path path(std::span<const program::Move> moves, double rapid_feed) {
  Layer layer(moves.size(), rapid_feed);
  for (std::size_t i = 0; i < moves.size(); ++i) {
    layer.add(moves[i], static_cast<std::uint32_t>(i));
  }
  return layer.finish();
}

PathPoint point_at(const Piece& piece, double u) noexcept {
  PathPoint out;
  out.place[2] = piece.from[2] + u * (piece.to[2] - piece.from[2]);
  if (piece.arc()) {
    const double angle = piece.start + u * piece.turn;
    out.place[0] = piece.center[0] + piece.radius * std::cos(angle);
    out.place[1] = piece.center[1] + piece.radius * std::sin(angle);
    out.direction = angle + (piece.turn > 0 ? 0.25 : -0.25) * unit::turn;
  } else {
    out.place[0] = piece.from[0] + u * (piece.to[0] - piece.from[0]);
    out.place[1] = piece.from[1] + u * (piece.to[1] - piece.from[1]);
    out.direction = piece.upright() ? unknown
                                    : std::atan2(piece.to[1] - piece.from[1],
                                                 piece.to[0] - piece.from[0]);
  }
  return out;
}

Point tangent(const Piece& piece, double u) noexcept {
  const double flat = piece.horizontal / piece.length;
  const double up = (piece.to[2] - piece.from[2]) / piece.length;
  if (piece.upright()) return {0.0, 0.0, up};
  const double chi = point_at(piece, u).direction;
  return {flat * std::cos(chi), flat * std::sin(chi), up};
}

}  // namespace trochoid::stock
