#pragma once

#include <QWidget>
#include <functional>
#include <memory>
#include <optional>
#include <turnscan/core/result.hpp>
#include <turnscan/geometry/registration/point_pairs.hpp>

#include "explorer/inspection/explorer_parts.hpp"
#include "explorer/models.hpp"

class QComboBox;
class QLabel;
class QPushButton;

namespace turnscan {
struct ReconstructOptions;
}

namespace turnscan::studio {

class MessageLabel;
class PairTool;

/// Joins a pass that could not be joined automatically: its pose is determined from pairs of
/// corresponding points, clicked on the mesh so far and on the mesh of the pass.
class JoinPanel : public QWidget {
  Q_OBJECT
 public:
  using Options = std::function<Result<ReconstructOptions>()>;

  /// options: those of the reconstruction, queried when it begins.
  JoinPanel(const ExplorerParts& parts, Options options, QWidget* parent = nullptr);
  ~JoinPanel() override;

  bool is_picking() const;
  const Model* chosen(const QComboBox* box) const;
  const Model* fixed() const;  ///< on the left while pairs are picked
  const Model* moved() const;  ///< on the right

 Q_SIGNALS:
  void changed();  ///< is_picking() changed
  void said(const QString& text);

 private:
  QWidget* make_choice();
  QWidget* make_buttons();
  void fill();
  bool is_pair() const;
  void switch_picking(bool on);
  void show_pairs();
  void join();
  void take_apart();

  ExplorerParts parts_;
  Options options_;
  std::unique_ptr<PairTool> tool_;
  QComboBox *fixed_, *moved_;
  QPushButton *pick_, *undo_, *join_, *apart_;
  QLabel* text_;
  MessageLabel* error_;
  std::size_t known_ = 0;  ///< number of meshes of passes at the last update
  std::optional<PairFit> fit_;
};

}  // namespace turnscan::studio
