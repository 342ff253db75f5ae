"""Take the screenshots of the animation in docs/gallery: start, an event, the contact.

Run: python docs/draw_animation.py (needs Chromium and selenium, as `make test-browser` does)
"""

import shutil
import tempfile
from importlib.resources import files
from pathlib import Path

from selenium import webdriver
from selenium.webdriver.common.keys import Keys

from exactpt.render.film import film_of
from exactpt.render.page import page_of
from exactpt.scene.format import loads

GALLERY = Path(__file__).parent / "gallery"
FLAGS = ("--headless", "--no-sandbox", "--disable-gpu", "--window-size=1280,860")
STEPS = 7
"""The event that is shown, counted from the start."""


def main() -> None:
    """Write animation-start.png, animation-event.png and animation-contact.png."""
    demo = (files("exactpt") / "data" / "demo.json").read_text(encoding="utf-8")
    options = webdriver.ChromeOptions()
    options.binary_location = shutil.which("chromium") or ""
    for flag in FLAGS:
        options.add_argument(flag)
    driver = webdriver.Chrome(
        options=options, service=webdriver.ChromeService(shutil.which("chromedriver"))
    )
    with tempfile.TemporaryDirectory() as folder:
        page = Path(folder) / "demo.html"
        page.write_text(page_of(film_of(loads(demo), tiling="mixed")), encoding="utf-8")
        driver.get(page.as_uri())
        body = driver.find_element("tag name", "body")
        driver.save_screenshot(str(GALLERY / "animation-start.png"))
        for name in ("layer-bridges", "layer-shadows"):
            driver.find_element("id", name).click()
        for _ in range(STEPS):
            body.send_keys(Keys.ARROW_RIGHT)
        driver.save_screenshot(str(GALLERY / "animation-event.png"))
        driver.find_element("id", "layer-shadows").click()
        body.send_keys(Keys.END)
        driver.save_screenshot(str(GALLERY / "animation-contact.png"))
    driver.quit()


if __name__ == "__main__":
    main()
