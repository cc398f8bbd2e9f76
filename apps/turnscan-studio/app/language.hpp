#pragma once
// The language of the window: English, or a translation that the program was built with.

#include <QString>
#include <QStringList>
#include <vector>

class QCoreApplication;

namespace turnscan::studio {

struct Language {
  QString code;  ///< ISO 639: "es"
  QString name;  ///< in itself: "Español"
};

/// English first, then those that this build has.
std::vector<Language> languages();

/// What was chosen: a code of languages(), or empty for that of the system.
QString chosen_language();
void choose_language(const QString& code);

/// The code in which texts are shown: what was chosen, else the system's where it is one of
/// languages(), else English.
QString shown_language();

/// Translates texts that are made from now on. Texts that are not translated stay English.
void install_language(QCoreApplication& app, const QString& code);

}  // namespace turnscan::studio
