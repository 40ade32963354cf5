# SPDX-License-Identifier: BSD-3-Clause
"""The page of what was found in Chromium: it is drawn, a drag turns it, and table, image and 3D select the same pose; without WebGL image
and table are there. Needs the Debian packages chromium-driver and python3-selenium."""
import os
import shutil
import tempfile
import time

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

import ppfmeam
from ppfmeam import scripting
from meamtest import check, skip
from batchtest import dataset
from scripttest import scan_of_bin, works

try:
    from selenium import webdriver
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.support.ui import WebDriverWait
except ImportError:
    skip("no python3-selenium")
if not shutil.which("chromium") or not shutil.which("chromedriver"):
    skip("no chromium-driver")
SECONDS = 60  # that a page may take to come up without a graphics card
RED = 0.03  # share of the pixels at least that the first part has


def browser(*arguments, page="found.html", wanted="#detail h2"):
    options = webdriver.ChromeOptions()
    options.binary_location = shutil.which("chromium")
    for argument in ("headless=new", "no-sandbox", "disable-dev-shm-usage", "window-size=1400,1100", f"user-data-dir={tempfile.mkdtemp()}",
                     *arguments):
        options.add_argument("--" + argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    driver = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
    driver.get("file://" + os.path.abspath(page))
    WebDriverWait(driver, SECONDS).until(lambda driver: driver.find_elements(By.CSS_SELECTOR, wanted))
    return driver


def pixels_of(element):
    """What it looks like when two pictures of it are the same; rows go upwards."""
    last = None
    for _ in range(20):
        element.screenshot("shot.png")
        image = scripting.read_image("shot.png")
        pixels = vtk_to_numpy(image.GetPointData().GetScalars())[:, :3].astype(int)
        if last is not None and (pixels == last).all():
            break
        last = pixels
        time.sleep(0.2)
    return pixels


def click(driver, space, is_wanted):
    """Clicks in the 3D view in the middle of the largest square of pixels of a color."""
    pixels = pixels_of(space)
    width = int(space.rect["width"])
    wanted = is_wanted(*pixels.T).reshape(-1, width)
    side = 0
    while wanted.any():
        middle, side = numpy.argwhere(wanted)[0], side + 1
        wanted = wanted[:-1, :-1] & wanted[1:, :-1] & wanted[:-1, 1:] & wanted[1:, 1:]
    row, column = middle + side / 2
    height = len(pixels) // width
    ActionChains(driver).move_to_element_with_offset(space, int(column - width / 2), int(height / 2 - row)).click().perform()


def chosen(driver):
    """The ranks of the rows and of the outlines that are marked."""
    return [[element.get_attribute("data-rank") for element in driver.find_elements(By.CSS_SELECTOR, f"{kind}.chosen")]
            for kind in ("tr", "path")]


scan, truth, mesh = scan_of_bin()
found = ppfmeam.detect(ppfmeam.train(mesh), scan, poses=2)
found.save("found.html")
driver = browser("use-gl=angle", "use-angle=swiftshader", "enable-unsafe-swiftshader")
try:
    space = driver.find_element(By.ID, "space")
    first = pixels_of(space)
    red, green, blue = first.T
    share = ((red > 2 * green) & (red > 2 * blue) & (red > 60)).mean()
    check(len(numpy.unique(first, axis=0)) > 200 and share > RED / 10, f"scan and parts are drawn: {share}")
    check(len(driver.find_elements(By.CSS_SELECTOR, "#space .label")) == len(found), "labels")

    ActionChains(driver).move_to_element(space).click_and_hold().move_by_offset(120, 60).release().perform()
    turned = pixels_of(space)
    check((first != turned).any(axis=1).mean() > 0.1, "a drag turns")
    check(chosen(driver) == [[], []], "a drag selects nothing")

    driver.find_element(By.CSS_SELECTOR, 'tr.pose[data-rank="2"]').click()
    check(chosen(driver) == [["2"], ["2"]], f"a row selects: {chosen(driver)}")
    check((pixels_of(space) != turned).any(axis=1).mean() > 0.005, "the selected part is seen in 3D")
    why = driver.find_element(By.ID, "detail")
    check("Most for it: " in why.text and "logarithm" not in why.text, f"why, in short: {why.text}")
    why.find_element(By.TAG_NAME, "summary").click()
    check("For it, in the logarithm" in why.text, "why, in numbers")
    driver.execute_script("document.querySelector('path[data-rank=\"1\"]').dispatchEvent(new MouseEvent('click'))")
    check(chosen(driver) == [["1"], ["1"]], f"an outline selects: {chosen(driver)}")

    # A click in 3D where the second part's color is.
    driver.find_element(By.CSS_SELECTOR, 'tr.pose[data-rank="1"]').click()
    check(chosen(driver) == [[], []], "a second click selects nothing")
    click(driver, space, lambda red, green, blue: (green > 1.5 * red) & (green > 1.5 * blue) & (green > 60))
    check(chosen(driver) == [["2"], ["2"]], f"a click on the part selects it: {chosen(driver)}")

    # The scan tells the place, and what to ask there.
    click(driver, space, lambda red, green, blue: (abs(red - green) < 8) & (abs(blue - green) < 8) & (red > 60))
    detail = driver.find_element(By.ID, "detail").text
    check(detail.startswith("Place ") and "ppfmeam.why(model, scan, poses=2, at=(" in detail, detail)
    check(not driver.get_log("browser"), "no error")
finally:
    driver.quit()

driver = browser("disable-3d-apis")
try:
    check("no WebGL" in driver.find_element(By.ID, "space").text, "it says why 3D is missing")
    driver.find_element(By.CSS_SELECTOR, 'tr.pose[data-rank="2"]').click()
    check(chosen(driver) == [["2"], ["2"]], "table and image work")
    image = pixels_of(driver.find_element(By.ID, "picture"))
    check(len(numpy.unique(image, axis=0)) > 200, "the image is there")
finally:
    driver.quit()

# Picks: the gripper stands at the best one at first, and at that of each pose that is selected.
picks = ppfmeam.pick(found, ppfmeam.grasps(mesh, propose="suction", cup_diameter=6), bin="none")
check(picks[0].possible and len(found) == 2, f"{picks}")
picks.save("picks.html")
driver = browser("use-gl=angle", "use-angle=swiftshader", "enable-unsafe-swiftshader", page="picks.html")


def green():
    red, green, blue = pixels_of(driver.find_element(By.ID, "space")).T
    return ((green > 1.5 * red) & (green > 1.5 * blue)).mean()


try:
    best = str(picks[0].instance + 1)
    rows = {row.get_attribute("data-rank"): row for row in driver.find_elements(By.CSS_SELECTOR, "tr.pose")}
    check(chosen(driver) == [[best], [best]], f"the pose of the best pick is selected: {chosen(driver)}")
    told, shares = [driver.find_element(By.ID, "detail").text.splitlines()[1]], [green()]
    for rank in (best, *rows.keys() - {best}):
        rows[rank].click()
        told.append(driver.find_element(By.ID, "detail").text.splitlines()[1])
        shares.append(green())
    first, nothing, second = shares
    check(first > nothing + 0.05 and second > nothing + 0.02, f"the green gripper is drawn with a selected pose alone: {shares}")
    check(told[0].startswith("Pick 1, ") and told[2].startswith("Pick "), f"{told}")
    check(not driver.get_log("browser"), "no error")
finally:
    driver.quit()

# A dataset that was evaluated with poses moved away: the first image, then the chosen one, in a frame.
dataset("bins", 2)
with open("none.csv", "w", encoding="utf-8") as file:
    print("scene_id,im_id,obj_id,score,R,t,time\n0,0,1,1,1 0 0 0 1 0 0 0 1,0 0 700,1", file=file)
works("evaluate.py", "bop", "bins", "--found", "none.csv", "--report", "evaluated.html")
driver = browser("use-gl=angle", "use-angle=swiftshader", "enable-unsafe-swiftshader", page="evaluated.html", wanted="iframe")
try:
    for name, counts in (("000000", ["right: 0", "wrong: 1"]), ("000001", ["right: 0", "wrong: 0"])):
        link = driver.find_element(By.LINK_TEXT, f"{name}/000000")
        link.click()
        driver.switch_to.frame(driver.find_element(By.TAG_NAME, "iframe"))
        WebDriverWait(driver, SECONDS).until(
            lambda driver: f"{name}/000000" in driver.find_element(By.TAG_NAME, "h1").text and driver.find_elements(By.CSS_SELECTOR, "#legend div"))
        legend = [each.text for each in driver.find_elements(By.CSS_SELECTOR, "#legend div")]
        missed = driver.find_elements(By.XPATH, "//div[@class='label'][text()='missed']")
        check(legend == [*counts, f"missed: {len(missed)}"] and missed, f"{legend}, {len(missed)} labels")
        red, green, blue = pixels_of(driver.find_element(By.ID, "space")).T
        check(((red > 2 * blue) & (green > 1.5 * blue) & (red > 100)).mean() > 0.003, "missed copies are drawn in their color")
        driver.switch_to.default_content()
        check([row.text.split()[0] for row in driver.find_elements(By.CSS_SELECTOR, "tr.chosen")] == [f"{name}/000000"], "the row is marked")
    check(not driver.get_log("browser"), "no error")
finally:
    driver.quit()
