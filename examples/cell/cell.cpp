// SPDX-License-Identifier: BSD-3-Clause
// A picking cell in one file, to be copied and changed: scans come in, the best pick of each goes to the robot.
//
//     cell part.meam part.stl part.grasps.json scan.pcd                                // prints the line of one scan
//     cell part.meam part.stl part.grasps.json --watch scans --robot-frame robot.json  // as they arrive, for a robot
//     cell part.meam part.stl part.grasps.json --replay cell.log                       // the same scans once more
//
// The robot's program connects, sends NEXT, and gets a line of the newest scan, PICK ... or NONE ... (docs/robot.md).
// It links meam::detect and meam::pick, which are under the BSD licence; see cell.py for the same program in Python.
#include <meam/picks.h>

#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <map>
#include <set>
#include <sstream>

namespace
{
using Clock = std::chrono::steady_clock;
using Options = std::map<std::string, std::string>;
struct Part
{
  std::string model, cad, grasps;
};

// What to change for a cell of your own; mm and seconds.
constexpr double Opening = 60.0, FingerWidth = 8.0, FingerThickness = 5.0; // of the jaws; of a cup: kind, cupDiameter
constexpr double Probability = 0.5;                    // that a copy is there: less likely ones are not picked
constexpr double WayIn = 80.0;                         // straight to the grasp, free of everything
constexpr auto Quiet = std::chrono::milliseconds(200); // a file is whole when nothing was written to it for so long
constexpr int LastPort = 65535;
constexpr int Pause = 20;                    // ms between two looks at the folder
constexpr std::size_t LongestRequest = 1024; // bytes: who sends more without an end is no robot

// What the robot is told of a scan: a pick, or why there is none.
struct Answer
{
  std::string scan, reason;
  std::optional<Eigen::Isometry3d> transform;
  double width = 0.0, clearance = 0.0, probability = 0.0;
  std::optional<int> part; // of several types, from 1

  std::string line(const Eigen::Isometry3d& T_base_gripper = Eigen::Isometry3d::Identity()) const
  {
    if (!this->transform)
    {
      std::string words = "NONE", word;
      for (std::istringstream text(this->reason); text >> word;)
      {
        words += " " + word;
      }
      return words;
    }
    const Eigen::Isometry3d T = T_base_gripper * *this->transform;
    Eigen::Quaterniond q(T.linear());
    q.coeffs() *= q.w() < 0.0 ? -1.0 : 1.0;
    const Eigen::Vector3d start = T * Eigen::Vector3d(0.0, 0.0, -WayIn);
    std::ostringstream text;
    const Eigen::IOFormat inRow(Eigen::StreamPrecision, Eigen::DontAlignCols, " ", " ");
    text << "PICK " << std::fixed << std::setprecision(3) << T.translation().format(inRow) << ' '
         << std::setprecision(6) << q.coeffs().format(inRow) << ' ' << std::setprecision(3) << start.format(inRow)
         << ' ' << this->width << ' ' << this->clearance << ' ' << this->probability;
    if (this->part)
    {
      text << ' ' << *this->part;
    }
    return text.str();
  }
};

// A number that was given, 0 or more.
double numberOf(const Options& options, const std::string& name)
{
  std::istringstream text(options.at(name));
  double value = -1.0;
  if (!(text >> value) || !text.eof() || value < 0.0)
  {
    throw meam::Error(name + " has to be a number, 0 or more, not " + options.at(name));
  }
  return value;
}

class Cell
{
public:
  Cell(const std::vector<Part>& parts, const Options& options)
    : Given(options)
  {
    numberOf(options, "--time-limit"); // what is wrong shows now
    for (const Part& part : parts)
    {
      this->Models.push_back(meam::loadModel(part.model));
      this->Pickers.emplace_back(
        this->Models.back(), meam::loadMesh(part.cad), meam::loadGrasps(part.grasps), gripper(), planning());
    }
    if (options.count("--robot-frame"))
    {
      this->Place.T_robot_camera = meam::loadRobotFrame(options.at("--robot-frame"));
    }
  }

  // The answer to a scan; whatever is wrong with it is a reason.
  Answer take(const std::string& path) const
  try
  {
    meam::DetectSettings settings;
    settings.maximumPoses = 0; // what is not picked stands in the way
    settings.minimumProbability = Probability;
    settings.timeLimit = numberOf(this->Given, "--time-limit");            // the best that are found by then are used
    const meam::Scan scan = meam::loadScan(path, this->given("--camera")); // of depth images meam::loadDepthImage
    const meam::Detections found = meam::detect(this->Models, scan, settings);
    std::cerr << found.warning << (found.warning.empty() ? "" : "\n");
    if (found.poses.empty())
    {
      return { path, "no part was found", {} };
    }
    const meam::PickPlan plan = meam::Picker::planAll(this->Pickers, found, scan, this->Place);
    const meam::PlannedPick& best = plan.picks.front();
    if (!best.possible)
    {
      return { path, plan.report + " " + plan.advice, {} };
    }
    return { path, "", best.T_robot_grasp ? *best.T_robot_grasp : best.T_scan_grasp, best.width, best.clearance,
      found.poses[best.instance].probability, this->Models.size() > 1 ? std::optional(best.part + 1) : std::nullopt };
  }
  catch (const std::exception& error) // the next scan is not to wait for it
  {
    return { path, error.what(), {} };
  }

  // A line of the log: time, SCAN or SENT, the scan, what it was answered with. Of a scan --out has it, too.
  void note(const std::string& kind, const Answer& answer, const std::string& line) const
  {
    const std::string log = this->given("--log"), out = this->given("--out");
    const std::time_t now = std::time(nullptr);
    if (!log.empty() &&
        !(std::ofstream(log, std::ios::app) << std::put_time(std::gmtime(&now), "%FT%TZ") << '\t' << kind << '\t'
                                            << answer.scan << '\t' << line << std::endl))
    {
      std::cerr << "cannot write " << log << '\n';
    }
    if (!out.empty() && kind == "SCAN" && // whole or not at all
        (!(std::ofstream(out + ".part") << line << std::endl) ||
          std::rename((out + ".part").c_str(), out.c_str()) != 0))
    {
      std::cerr << "cannot write " << out << '\n';
    }
    std::cout << kind << ' ' << answer.scan << ' ' << line << std::endl;
  }

private:
  std::string given(const std::string& option) const
  {
    const auto found = this->Given.find(option);
    return found == this->Given.end() ? "" : found->second;
  }
  static meam::GripperModel gripper()
  {
    meam::GripperModel jaws;
    jaws.opening = Opening;
    jaws.fingerWidth = FingerWidth;
    jaws.fingerThickness = FingerThickness;
    return jaws;
  }
  static meam::PlanSettings planning()
  {
    meam::PlanSettings settings;
    settings.wayIn = WayIn;
    return settings;
  }

  Options Given;
  std::vector<meam::Model> Models;
  std::vector<meam::Picker> Pickers;
  meam::Workplace Place; // the bin is found in each scan by its rim, unless it is given here
};

// Scans that arrive. Those that lie there at the start are old: what was in the bin may have gone.
class Folder
{
public:
  using Time = std::filesystem::file_time_type;

  explicit Folder(std::string path)
    : Path(std::move(path))
  {
    this->look(true);
  }

  // The scans that are whole and new, by when they were written.
  std::multimap<Time, std::string> look(bool isStart = false)
  {
    std::multimap<Time, std::string> whole;
    for (const auto& entry : std::filesystem::directory_iterator(this->Path))
    {
      const std::string path = entry.path().string(), extension = entry.path().extension().string();
      std::error_code error;
      const Time written = entry.last_write_time(error);
      const auto size = entry.file_size(error);
      if ((extension != ".pcd" && extension != ".ply" && extension != ".xyz") || error)
      {
        continue;
      }
      State& file = this->Files[path];
      if (file.size != size || file.written != written)
      {
        file = { size, written, Clock::now(), isStart };
      }
      else if (!file.isTaken && Clock::now() - file.since >= Quiet)
      {
        file.isTaken = true;
        whole.emplace(written, path);
      }
    }
    return whole;
  }

private:
  struct State
  {
    std::uintmax_t size = 0;
    Time written;
    Clock::time_point since;
    bool isTaken = false;
  };
  std::string Path;
  std::map<std::string, State> Files;
};

// The robot's program, at the other end of a connection: the one that came last.
class Robot
{
public:
  std::optional<std::string> request;

  explicit Robot(double port)
  {
    if (port > LastPort || port != std::floor(port))
    {
      throw meam::Error("--port has to be a whole number up to " + std::to_string(LastPort));
    }
    const int yes = 1;
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    if (setsockopt(this->Server, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) != 0 ||
        bind(this->Server, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0 || listen(this->Server, 1) != 0)
    {
      throw meam::Error(
        "Nobody can connect to port " + std::to_string(std::lround(port)) + ": " + std::strerror(errno));
    }
  }
  Robot(const Robot&) = delete;
  void operator=(const Robot&) = delete;
  ~Robot()
  {
    this->connect(-1);
    close(this->Server);
  }

  // Waits at most so long for the next request.
  void wait(int milliseconds)
  {
    pollfd ends[] = { { this->Server, POLLIN, 0 }, { this->Link, POLLIN, 0 } };
    poll(ends, 2, milliseconds);
    char bytes[LongestRequest];
    if (ends[0].revents != 0)
    {
      this->connect(accept(this->Server, nullptr, nullptr));
    }
    else if (ends[1].revents != 0)
    {
      const ssize_t count = recv(this->Link, bytes, sizeof bytes, 0);
      this->Text.append(bytes, count > 0 ? static_cast<std::size_t>(count) : 0);
      for (std::size_t end; (end = this->Text.find('\n')) != std::string::npos; this->Text.erase(0, end + 1))
      {
        this->request = this->Text.substr(0, end);
      }
      if (count <= 0 || this->Text.size() > LongestRequest) // it has gone, or is no robot
      {
        this->connect(-1);
      }
    }
  }

  // Whether it was sent; of one that was not the robot may ask again.
  bool send(const std::string& line)
  {
    this->request.reset();
    const std::string text = line + "\n";
    const bool sent = ::send(this->Link, text.data(), text.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(text.size());
    if (!sent)
    {
      this->connect(-1);
    }
    return sent;
  }

private:
  void connect(int link)
  {
    if (this->Link >= 0)
    {
      close(this->Link);
    }
    this->Link = link;
    this->Text.clear();
    this->request.reset();
  }

  int Server = socket(AF_INET, SOCK_STREAM, 0);
  int Link = -1;
  std::string Text;
};

// T_base_gripper of NEXT x y z qx qy qz qw, mm: where the gripper was at the scan, of a camera on it. NEXT: of one
// beside the robot.
std::optional<Eigen::Isometry3d> gripperOf(const std::string& request)
{
  std::istringstream text(request);
  std::string word;
  text >> word;
  std::vector<double> values;
  for (double value; word == "NEXT" && text >> value;)
  {
    values.push_back(value);
  }
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  if (word != "NEXT" || !text.eof() || (!values.empty() && values.size() != 7))
  {
    return {};
  }
  if (values.size() == 7)
  {
    const Eigen::Quaterniond q(values[6], values[3], values[4], values[5]);
    if (!(std::abs(q.norm() - 1.0) < 0.01))
    {
      return {};
    }
    T = Eigen::Translation3d(values[0], values[1], values[2]) * q.normalized();
  }
  return T;
}

// Each scan is answered once; a newer one takes the place of one that nobody has asked for.
[[noreturn]] void serve(const Cell& cell, Folder folder, Robot& robot)
{
  std::optional<Answer> newest;
  for (;;)
  {
    for (const auto& [time, scan] : folder.look())
    {
      newest = cell.take(scan);
      cell.note("SCAN", *newest, newest->line());
    }
    robot.wait(Pause);
    const std::optional<Eigen::Isometry3d> T_base_gripper = gripperOf(robot.request.value_or("NEXT"));
    if (!T_base_gripper)
    {
      robot.send("NONE the request has to be NEXT, or NEXT x y z qx qy qz qw, where the gripper was at the scan");
    }
    else if (robot.request && newest)
    {
      const std::string line = newest->line(*T_base_gripper);
      if (robot.send(line))
      {
        cell.note("SENT", *newest, line);
        newest.reset();
      }
    }
  }
}

// Whether the scans of a log are answered as they were.
bool isReplayed(const Cell& cell, const std::string& log)
{
  bool same = true;
  std::ifstream file(log);
  if (!file)
  {
    throw meam::Error("There is no log " + log);
  }
  for (std::string time, kind, scan, line; std::getline(file, time, '\t') && std::getline(file, kind, '\t') &&
                                           std::getline(file, scan, '\t') && std::getline(file, line);)
  {
    if (kind == "SCAN")
    {
      const std::string now = cell.take(scan).line();
      same = same && now == line;
      std::cout << (now == line ? scan + ": the same\n"
                                : scan + ": it was " + line + "\n" + scan + ": it is  " + now + "\n");
    }
  }
  return same;
}
}

int main(int argc, char** argv)
try
{
  std::vector<std::string> files;
  std::vector<Part> beside;
  Options options{ { "--port", "5050" }, { "--time-limit", "2" } };
  const std::set<std::string> known{ "--watch", "--port", "--robot-frame", "--camera", "--time-limit", "--out", "--log",
    "--replay" }; // as cell.py has them
  std::string wrong;
  for (int k = 1; k < argc; ++k)
  {
    const std::string word = argv[k];
    if (word.compare(0, 2, "--") != 0)
    {
      files.push_back(word);
    }
    else if (word == "--beside" && k + 3 < argc)
    {
      beside.push_back({ argv[k + 1], argv[k + 2], argv[k + 3] });
      k += 3;
    }
    else if (known.count(word) != 0 && k + 1 < argc)
    {
      options[word] = argv[++k];
    }
    else
    {
      wrong = "there is no option " + word + ", or a word is missing after it\n";
    }
  }
  if (files.size() == 3 && !options.count("--watch") && !options.count("--replay"))
  {
    wrong += "give scans, --watch or --replay\n";
  }
  if (files.size() < 3 || !wrong.empty())
  {
    std::cerr << wrong
              << "usage: cell MODEL CAD GRASPS [--beside MODEL CAD GRASPS]... [SCAN...] [--watch FOLDER] [--port N] "
                 "[--robot-frame FILE] [--camera FILE] "
                 "[--time-limit SECONDS] "
                 "[--out FILE] [--log FILE] [--replay LOG]\n";
    return 2;
  }
  const double port = numberOf(options, "--port");
  numberOf(options, "--time-limit"); // what is wrong shows now
  if (options.count("--replay"))
  {
    options["--time-limit"] = "0"; // none
  }
  beside.insert(beside.begin(), { files[0], files[1], files[2] });
  const Cell cell(beside, options);
  if (options.count("--replay"))
  {
    return isReplayed(cell, options["--replay"]) ? 0 : 1;
  }
  for (std::size_t k = 3; k < files.size(); ++k)
  {
    const Answer answer = cell.take(files[k]);
    cell.note("SCAN", answer, answer.line());
  }
  if (options.count("--watch"))
  {
    Robot robot(port);
    serve(cell, Folder(options["--watch"]), robot);
  }
}
catch (const std::exception& error)
{
  std::cerr << error.what() << '\n';
  return 1;
}
