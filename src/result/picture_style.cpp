#include "result/picture_style.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "base/text.hpp"
#include "signorini/error.hpp"

namespace signorini::result {
namespace {

constexpr double wide = 1120.0;                                           // pixels
constexpr double pixels_a_mm = 96.0 / 25.4, dots_a_pixel = 300.0 / 96.0;  // PNG: 300 dots per inch
constexpr double usual_dots = 1.5;                                        // PNG: dots per pixel
constexpr double max_dots = 32000.0;                                      // limit of the dots per side
constexpr double letter_height = 13.0;                                    // pixels
constexpr double least_letter =
    6.0 * 96.0 / 72.0;  // pixels: 6 points, the smallest size that journals accept

std::string white(const std::string& size, double font) {
  return fmt::format("size {} background '#ffffff' font 'DejaVu Sans,{:.4g}'", size, font);
}

}  // namespace

const std::vector<std::string>& picture_formats() {
  static const std::vector<std::string> names = {"svg", "png", "pdf"};
  return names;
}

void read_size(const std::string& text, PictureStyle& look) {
  const std::size_t cross = text.find('x');
  const auto width = base::parse_number(text.substr(0, cross));
  const bool both = cross != std::string::npos;
  const auto height = base::parse_number(both ? text.substr(cross + 1) : "0");
  const auto fits = [](double mm) { return mm >= 20.0 && mm <= 2000.0; };
  if (!width || !height || !fits(*width) || (both && !fits(*height)))
    throw UsageError(
        fmt::format("--size: found \"{}\", expected WIDTH or WIDTHxHEIGHT in mm, 20 to 2000 each", text));
  look.width = *width;
  look.height = *height;
}

void read_formats(const std::string& text, PictureStyle& look) {
  look.formats.clear();
  std::istringstream words(text);
  const std::vector<std::string>& known = picture_formats();
  for (std::string word; std::getline(words, word, ',');) {
    if (std::find(known.begin(), known.end(), word) == known.end())
      throw UsageError(fmt::format("--format: found \"{}\"{}", word, base::suggestion(word, known)));
    if (std::find(look.formats.begin(), look.formats.end(), word) == look.formats.end())
      look.formats.push_back(word);
  }
  if (look.formats.empty()) throw UsageError("--format: found no format, expected svg, png or pdf");
}

void read_language(const std::string& text, PictureStyle& look) {
  const std::vector<std::string>& known = picture_languages();
  if (std::find(known.begin(), known.end(), text) == known.end())
    throw UsageError(fmt::format("--language: found \"{}\"{}", text, base::suggestion(text, known)));
  look.language = text;
}

double Canvas::left() const { return (narrow() ? 96.0 : 112.0) / width; }

double Canvas::right(double legend) const {
  const double room = narrow() ? legend * 155.0 / usual_legend : legend;
  return 1.0 - std::min(room / width, 0.5);
}

Canvas canvas_of(const PictureStyle& look, double height, bool over_time, bool fixed) {
  Canvas canvas;
  canvas.height = height;
  if (look.width <= 0.0) return canvas;
  const double size = look.width * pixels_a_mm;
  canvas.pixel = std::max(least_letter / letter_height, 1.05 * size / wide);
  const double high = over_time ? look.height * pixels_a_mm : 0.0;
  // A panel of less than half the usual height has no room for its labels: letters become smaller.
  if (high > 0.0) canvas.pixel = std::min(canvas.pixel, high / (0.5 * height));
  canvas.width = size / canvas.pixel;
  if (high > 0.0) {
    canvas.height = high / canvas.pixel;
  } else if (!fixed) {
    canvas.height *= std::sqrt(canvas.width / wide);
  }
  return canvas;
}

double max_canvas_height(const PictureStyle& look) {
  const double dots = look.width > 0.0 ? dots_a_pixel : usual_dots;
  return max_dots / (dots * canvas_of(look, 0.0, false, true).pixel);
}

std::string terminals(const Canvas& canvas, bool sized) {
  const double dots = sized ? dots_a_pixel : usual_dots;
  const auto size = [&](double scale) {
    return fmt::format("{},{}", std::lround(canvas.width * canvas.pixel * scale),
                       std::lround(canvas.height * canvas.pixel * scale));
  };
  const double font = canvas.font(letter_height), line = canvas.pixel;
  return fmt::format(
      "if (format eq 'svg') {{ set terminal svg noenhanced {} linewidth {:.4g} }}\n"
      "if (format eq 'png') {{ set terminal pngcairo noenhanced {} fontscale {:.4g} linewidth {:.4g} "
      "pointscale {:.4g} }}\n"
      "if (format eq 'pdf') {{ set terminal pdfcairo noenhanced {} linewidth {:.4g} pointscale {:.4g} }}\n",
      white(size(1.0), font), line, white(size(dots), font), 1.3 / 1.5 * dots, dots * line,
      sized ? line : 1.0,
      white(fmt::format("{:.3f}in,{:.3f}in", canvas.width * canvas.pixel / 96.0,
                        canvas.height * canvas.pixel / 96.0),
            0.75 * font),
      line, line);
}

namespace {

// clang-format off
constexpr std::array words = {
    std::array<std::string_view, 3>{"time t", "Zeit t", "время t"},
    std::array<std::string_view, 3>{"horizontal ux", "horizontal ux", "горизонтальное ux"},
    std::array<std::string_view, 3>{"vertical uy", "vertikal uy", "вертикальное uy"},
    std::array<std::string_view, 3>{"rotation rz", "Verdrehung rz", "поворот rz"},
    std::array<std::string_view, 3>{"displacement u", "Verschiebung u", "перемещение u"},
    std::array<std::string_view, 3>{"acceleration", "Beschleunigung", "ускорение"},
    std::array<std::string_view, 3>{"energy", "Energie", "энергия"},
    std::array<std::string_view, 3>{"error of the balance", "Bilanzfehler", "невязка баланса"},
    std::array<std::string_view, 3>{"drift", "Drift", "дрейф"},
    std::array<std::string_view, 3>{"kinetic", "kinetisch", "кинетическая"},
    std::array<std::string_view, 3>{"elastic", "elastisch", "упругая"},
    std::array<std::string_view, 3>{"contact springs", "Kontaktfedern", "в контактах"},
    std::array<std::string_view, 3>{"lost by damping", "Dämpfungsverlust", "потери: демпф."},
    std::array<std::string_view, 3>{"lost by friction", "Reibungsverlust", "потери: трение"},
    std::array<std::string_view, 3>{"lost by impacts", "Stoßverlust", "потери: удары"},
    std::array<std::string_view, 3>{"work of loads", "Arbeit der Lasten", "раб. нагрузок"},
    std::array<std::string_view, 3>{"work of surfaces", "Arbeit d. Flächen", "раб. поверхн."},
    std::array<std::string_view, 3>{"compression", "Druckkraft", "сжатие"},
    std::array<std::string_view, 3>{"shear", "Schubkraft", "сдвигающая сила"},
    std::array<std::string_view, 3>{"limits", "Grenzen", "предел"},
    std::array<std::string_view, 3>{"static", "Haftgrenze", "статический"},
    std::array<std::string_view, 3>{"kinetic limit", "Gleitgrenze", "кинетический"},
    std::array<std::string_view, 3>{"gap g", "Spalt g", "зазор g"},
    std::array<std::string_view, 3>{"motion ut", "Bewegung ut", "движение ut"},
    std::array<std::string_view, 3>{"slip p", "Gleitweg p", "проскальз. p"},
    std::array<std::string_view, 3>{"event", "Ereignis", "событие"},
    std::array<std::string_view, 3>{"open", "offen", "открыт"},
    std::array<std::string_view, 3>{"closed", "geschlossen", "закрыт"},
    std::array<std::string_view, 3>{"stick", "Haften", "сцепление"},
    std::array<std::string_view, 3>{"slip", "Gleiten", "скольжение"},
    std::array<std::string_view, 3>{"slip+", "Gleiten +", "скольжение +"},
    std::array<std::string_view, 3>{"slip-", "Gleiten −", "скольжение −"},
    std::array<std::string_view, 3>{"reversal", "Umkehr", "реверс"},
    std::array<std::string_view, 3>{"separation", "Abheben", "отрыв"},
    std::array<std::string_view, 3>{"contact", "Aufsetzen", "касание"},
    std::array<std::string_view, 3>{"impact", "Stoß", "удар"},
    std::array<std::string_view, 3>{"load changes", "Lastwechsel", "смена нагрузки"},
    std::array<std::string_view, 3>{"undeformed", "unverformt", "до деформации"},
    std::array<std::string_view, 3>{"nodes", "Knoten", "узлы"},
    std::array<std::string_view, 3>{"supports", "Lager", "опоры"},
    std::array<std::string_view, 3>{"springs", "Federn", "пружины"},
    std::array<std::string_view, 3>{"rigid bodies", "starre Körper", "жёсткие тела"},
    std::array<std::string_view, 3>{"mesh", "Netz", "сетка"},
    std::array<std::string_view, 3>{"bars", "Stäbe", "стержни"},
    std::array<std::string_view, 3>{"beams", "Balken", "балки"},
    std::array<std::string_view, 3>{"contact force", "Kontaktkraft", "сила контакта"},
    std::array<std::string_view, 3>{"first {} of {}", "die ersten {} von {}", "первые {} из {}"},
    std::array<std::string_view, 3>{"the {} of {} with the largest motion", "die {} von {}, die sich am meisten bewegen", "{} из {} с наибольшим движением"},
    std::array<std::string_view, 3>{"no friction", "ohne Reibung", "без трения"},
    std::array<std::string_view, 3>{"friction {}", "Reibung {}", "трение {}"},
    std::array<std::string_view, 3>{"friction {} static, {} kinetic", "Reibung {} (Haften), {} (Gleiten)", "трение {} (покоя), {} (скольжения)"},
    std::array<std::string_view, 3>{"Contact '{}'", "Kontakt '{}'", "Контакт '{}'"},
    std::array<std::string_view, 3>{"Displacements from the undeformed state", "Verschiebungen gegen den unverformten Zustand", "Перемещения относительно недеформированного состояния"},
    std::array<std::string_view, 3>{"Response quantities", "Antwortgrößen", "Величины отклика"},
    std::array<std::string_view, 3>{"Stored energy, work, losses and balance", "Wo die Energie ist, wohin sie ging, und die Bilanz", "Где энергия, куда она ушла, и баланс"},
    std::array<std::string_view, 3>{"States of the contacts", "Zustände der Kontakte", "Состояния контактов"},
    std::array<std::string_view, 3>{"Events of the contacts, one mark per event", "Ereignisse der Kontakte, je ein Strich", "События контактов, по отметке на каждое"},
    std::array<std::string_view, 3>{"Loads and motion of the base", "Lasten und Bewegung des Bodens", "Нагрузки и движение основания"},
    std::array<std::string_view, 3>{"Contact forces and friction cones", "Kontaktkräfte und Reibungskegel", "Силы контактов и конусы трения"},
    std::array<std::string_view, 3>{"stick inside, slip on the edge", "innen haftet es, am Rand gleitet es", "внутри сцепление, на границе скольжение"},
    std::array<std::string_view, 3>{"Shape at t = {} {}", "Form bei t = {} {}", "Форма при t = {} {}"},
    std::array<std::string_view, 3>{"slid by ({}, {}) {}, deformation", "verschoben um ({}, {}) {}, Verformung", "сдвиг на ({}, {}) {}, деформация"},
    std::array<std::string_view, 3>{"displacements", "Verschiebungen", "перемещения"},
    std::array<std::string_view, 3>{"in true scale", "maßstäblich", "в масштабе"},
    std::array<std::string_view, 3>{"magnified {} times", "{}-fach vergrößert", "увеличение в {} раз"},
    std::array<std::string_view, 3>{"longest arrow of the run: {} {}", "längster Pfeil des Laufs: {} {}", "наибольшая стрелка расчёта: {} {}"},
    std::array<std::string_view, 3>{" (run {})", " (Lauf {})", " (расчёт {})"},
    std::array<std::string_view, 3>{"stopped", "abgebrochen", "остановлен"},
    std::array<std::string_view, 3>{"interrupted", "unterbrochen", "прерван"},
    std::array<std::string_view, 3>{"shaded: not certified, from t = {} on", "schattiert: nicht gesichert, ab t = {}", "серым: не гарантировано, с t = {}"},
};
// clang-format on

}  // namespace

const std::vector<std::string>& picture_languages() {
  static const std::vector<std::string> names = {"en", "de", "ru"};
  return names;
}

std::string translate(std::string_view language, std::string_view english) {
  const std::vector<std::string>& known = picture_languages();
  for (const auto& row : words)
    for (std::size_t i = 1; i < row.size(); ++i)
      if (row[0] == english && known[i] == language) return std::string(row[i]);
  return std::string(english);
}

std::vector<std::string> translated_phrases() {
  std::vector<std::string> phrases;
  for (const auto& row : words) phrases.emplace_back(row[0]);
  return phrases;
}

}  // namespace signorini::result
