// SPDX-License-Identifier: BSD-3-Clause
// Turns the page's data into 3D and keeps picture, table and 3D at the same chosen pose. Needs THREE and THREE.OrbitControls.
"use strict";
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const element = id => document.getElementById(id);
  const all = (selector, work) => document.querySelectorAll(selector).forEach(work);
  const state = { chosen: data.chosen, least: data.likely, place: null, byPart: data.parts.length > 1 && !data.legend.length };
  const shown = pose => pose.place === undefined || pose.place >= state.least || pose.rank === state.chosen || pose.judged === "right";
  const inkOf = color => [1, 3, 5].reduce((sum, k, i) => sum + parseInt(color.slice(k, k + 2), 16) * [0.3, 0.59, 0.11][i], 0) < 140 ? "#fff" : "#111";
  const fixed = (values, digits) => values.map(value => value.toFixed(digits));
  const palette = ["#4dafc7", "#e67e22", "#8c56a5", "#9ac13d", "#a76c49",
    "#00ffcc", "#ff00e6", "#e6e6b3", "#4d00ff", "#00ff00", "#ffccff", "#e60066"]; // of types of part, as ParaView has them
  const colorOf = pose => state.byPart ? palette[pose.part % palette.length] : pose.color;
  let space = null; // the 3D view; null without WebGL

  function bytes(text) {
    const letters = atob(text), result = new Uint8Array(letters.length);
    for (let i = 0; i < letters.length; ++i) result[i] = letters.charCodeAt(i);
    return result.buffer;
  }

  function positions(cloud) {
    const shares = new Uint16Array(bytes(cloud.positions)), result = new Float32Array(shares.length);
    for (let i = 0; i < shares.length; ++i) result[i] = cloud.low[i % 3] + shares[i] * cloud.step[i % 3];
    return result;
  }

  // ---- the 3D view
  function makeSpace(holder, renderer) {
    renderer.setPixelRatio(window.devicePixelRatio);
    renderer.setClearColor(0x1c1f24);
    holder.appendChild(renderer.domElement);
    const scene = new THREE.Scene(), light = new THREE.DirectionalLight(0xffffff, 0.75);
    scene.add(new THREE.AmbientLight(0xffffff, 0.4), light, light.target);

    const scan = positions(data.scan), channels = data.scan.channels, shades = new Uint8Array(bytes(data.scan.shades));
    const colors = new Uint8Array(3 * data.scan.count);
    for (let i = 0; i < colors.length; ++i) colors[i] = shades[channels === 3 ? i : Math.floor(i / 3)];
    const cloud = new THREE.BufferGeometry();
    cloud.setAttribute("position", new THREE.BufferAttribute(scan, 3));
    cloud.setAttribute("color", new THREE.BufferAttribute(colors, 3, true));
    const dots = new THREE.PointsMaterial({ vertexColors: THREE.VertexColors, sizeAttenuation: false });
    const points = new THREE.Points(cloud, dots);
    scene.add(points);

    const geometries = data.parts.map(part => {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.BufferAttribute(positions(part), 3));
      if (!part.triangles) return { geometry };
      geometry.setAttribute("normal", new THREE.BufferAttribute(new Int8Array(bytes(part.normals)), 3, true));
      geometry.setIndex(new THREE.BufferAttribute(new Uint32Array(bytes(part.triangles)), 1));
      return { geometry, edges: new THREE.EdgesGeometry(geometry, 30) };
    });
    const edges = new THREE.Group(), labels = document.createElement("div");
    holder.appendChild(labels);
    scene.add(edges);
    const copies = data.poses.map(pose => {
      const { geometry, edges: lines } = geometries[pose.part], matrix = new THREE.Matrix4().fromArray(pose.transform).transpose();
      const body = lines
        ? new THREE.Mesh(geometry, new THREE.MeshPhongMaterial({ specular: 0x222222, shininess: 20, side: THREE.DoubleSide, transparent: Boolean(data.marks), opacity: data.marks ? 0.35 : 1 }))
        : new THREE.Points(geometry, new THREE.PointsMaterial({ sizeAttenuation: false, size: 3 }));
      const outline = lines ? new THREE.LineSegments(lines, new THREE.LineBasicMaterial({ color: 0x0, transparent: true, opacity: 0.55 })) : null;
      for (const object of [body, outline].filter(Boolean)) {
        object.matrixAutoUpdate = false;
        object.matrix.copy(matrix);
      }
      body.userData.pose = pose;
      scene.add(body);
      if (outline) edges.add(outline);
      const label = document.createElement("div");
      label.className = "label";
      label.textContent = pose.tag || pose.rank + (pose.place === undefined ? "" : " · " + Math.round(100 * pose.place) + " %");
      labels.appendChild(label);
      return { pose, body, outline, label, middle: new THREE.Vector3().fromArray(data.parts[pose.part].middle).applyMatrix4(matrix) };
    });
    // Of picks: green where the gripper can go, red where it cannot, as in ParaView.
    const grippers = data.grippers.map(gripper => {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.BufferAttribute(positions(gripper), 3));
      geometry.computeVertexNormals();
      const material = new THREE.MeshPhongMaterial({ color: gripper.possible ? 0x3cb44b : 0xdc3232, transparent: true, opacity: 0.75, side: THREE.DoubleSide });
      const body = new THREE.Mesh(geometry, material);
      scene.add(body);
      return { gripper, body };
    });
    if (data.marks) addMarks(scene);
    const legend = holder.appendChild(Object.assign(document.createElement("div"), { id: "legend" }));
    legend.innerHTML = data.legend.map(([name, color]) => `<div><i style="background:${color}"></i>${name}</div>`).join("");
    const mark = new THREE.Mesh(new THREE.SphereGeometry(1, 16, 12), new THREE.MeshBasicMaterial({ color: 0xffffff, depthTest: false }));
    mark.visible = false;
    scene.add(mark);

    // Parallel, so that lengths are the same everywhere, as ParaView's first view of a scan.
    const looks = new THREE.Vector3().fromArray(data.scan.looks), camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0, 1);
    const bulk = new THREE.Box3(new THREE.Vector3().fromArray(data.scan.low_of_bulk), new THREE.Vector3().fromArray(data.scan.high_of_bulk));
    const middle = bulk.getCenter(new THREE.Vector3()), extent = bulk.getSize(new THREE.Vector3());
    cloud.computeBoundingSphere();
    const reach = cloud.boundingSphere.radius + cloud.boundingSphere.center.distanceTo(middle);
    camera.near = 0;
    camera.far = 3 * reach;
    camera.up.copy(looks).negate();
    const controls = new THREE.OrbitControls(camera, renderer.domElement);
    controls.enableKeys = false;
    controls.screenSpacePanning = true;
    controls.minZoom = 0.2;
    controls.maxZoom = 200;
    const up = new THREE.Vector3(0, -looks.z, 0); // rows of the scan go down
    let height = 1; // mm that the view shows at zoom 1

    function look(degrees) {
      const tilt = degrees * Math.PI / 180, aside = 20 * Math.PI / 180 * (degrees > 45);
      const from = looks.clone().multiplyScalar(-Math.cos(tilt)).addScaledVector(up, -Math.sin(tilt) * Math.cos(aside));
      from.x += Math.sin(tilt) * Math.sin(aside);
      controls.target.copy(middle);
      camera.position.copy(middle).addScaledVector(from, 1.5 * reach);
      camera.zoom = 1;
      resize();
      controls.update();
    }

    function resize() {
      const width = holder.clientWidth, tall = holder.clientHeight;
      renderer.setSize(width, tall);
      height = 1.08 * Math.max(extent.y, extent.x * tall / width, extent.z * 0.9);
      camera.top = height / 2;
      camera.bottom = -height / 2;
      camera.right = height / 2 * width / tall;
      camera.left = -camera.right;
      camera.updateProjectionMatrix();
      draw();
    }

    let waits = false;
    function draw() {
      if (waits) return;
      waits = true;
      requestAnimationFrame(() => { waits = false; drawNow(); });
    }

    function drawNow() {
      const tall = holder.clientHeight, width = holder.clientWidth, pixels = tall * camera.zoom / height; // of a mm
      const away = camera.getWorldDirection(new THREE.Vector3());
      // Along the line of sight nothing moves in the picture: points lie behind surfaces, lines before them.
      points.position.copy(away).multiplyScalar(data.scan.spacing);
      edges.position.copy(away).multiplyScalar(-0.3 * data.scan.spacing);
      dots.size = Math.min(12, Math.max(1.5, 1.15 * data.scan.spacing * pixels));
      light.position.copy(camera.position);
      light.target.position.copy(controls.target);
      mark.scale.setScalar(5 / pixels);
      for (const { pose, body, outline, label, middle } of copies) {
        const chosen = pose.rank === state.chosen, visible = shown(pose), at = middle.clone().project(camera);
        body.visible = visible;
        if (outline) {
          outline.visible = visible;
          outline.material.color.set(chosen ? 0xffffff : 0x0);
          outline.material.opacity = chosen ? 1 : 0.55;
        }
        body.material.color.set(colorOf(pose)).multiplyScalar(chosen || !state.chosen ? 1 : 0.45);
        label.style.background = colorOf(pose);
        label.style.color = inkOf(colorOf(pose));
        label.style.display = visible ? "" : "none";
        label.style.left = (at.x + 1) / 2 * width + "px";
        label.style.top = (1 - at.y) / 2 * tall + "px";
        label.style.zIndex = chosen ? 2 : 1;
        label.style.outline = chosen ? "2px solid #fff" : "none";
        label.style.opacity = chosen || !state.chosen ? 1 : 0.45;
      }
      for (const { gripper, body } of grippers) body.visible = gripper.rank === state.chosen;
      renderer.render(scene, camera);
      drawAxes(pixels);
    }

    function drawAxes(pixels) {
      const turn = camera.matrixWorldInverse, ends = ["x", "y", "z"].map((name, k) => {
        const axis = new THREE.Vector3().setComponent(k, 1).transformDirection(turn);
        return { name, axis, color: ["#ff6b6b", "#69db7c", "#74a9ff"][k] };
      }).sort((one, other) => one.axis.z - other.axis.z);
      axes.innerHTML = ends.map(({ name, axis, color }) => {
        const x = 36 * axis.x, y = -36 * axis.y;
        return `<line x2="${x}" y2="${y}" stroke="${color}" stroke-width="2.5"/><text x="${1.3 * x}" y="${1.3 * y + 4}" fill="${color}" text-anchor="middle">${name}</text>`;
      }).join("");
      const most = 130 / pixels, power = 10 ** Math.floor(Math.log10(most)), length = power * [5, 2, 1].find(k => k * power <= most);
      bar.innerHTML = `${length >= 1 ? length : length.toPrecision(1)} mm<i style="width:${length * pixels}px"></i>`;
    }

    const axes = document.createElementNS("http://www.w3.org/2000/svg", "svg"), bar = document.createElement("div");
    for (const [name, value] of [["id", "axes"], ["viewBox", "-50 -50 100 100"], ["width", 100], ["height", 100]]) axes.setAttribute(name, value);
    bar.id = "scale";
    const buttons = document.createElement("div");
    buttons.className = "buttons";
    holder.append(axes, bar, buttons);
    function button(text, work) {
      const made = document.createElement("button");
      made.textContent = text;
      made.addEventListener("click", () => work(made));
      buttons.appendChild(made);
      return made;
    }
    function toggle(text, object) {
      button(text, made => {
        object.visible = !object.visible;
        made.setAttribute("aria-pressed", object.visible);
        draw();
      }).setAttribute("aria-pressed", true);
    }
    button("From the sensor", () => look(0));
    button("Tilted", () => look(35));
    button("From the side", () => look(80));
    toggle("Scan", points);
    toggle("Edges", edges);
    button("Labels", made => {
      labels.hidden = !labels.hidden;
      made.setAttribute("aria-pressed", !labels.hidden);
    });

    if (data.parts.length > 1) {
      button("Color by part", made => {
        state.byPart = !state.byPart;
        made.setAttribute("aria-pressed", state.byPart);
        update();
      }).setAttribute("aria-pressed", state.byPart);
    }

    let pressed = null; // where, for a drag is no click
    const ray = new THREE.Raycaster();
    renderer.domElement.addEventListener("pointerdown", event => { pressed = [event.clientX, event.clientY]; });
    renderer.domElement.addEventListener("pointerup", event => {
      if (!pressed || event.button !== 0 || Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > 4) return;
      const box = renderer.domElement.getBoundingClientRect();
      ray.setFromCamera({ x: 2 * (event.clientX - box.left) / box.width - 1, y: 1 - 2 * (event.clientY - box.top) / box.height }, camera);
      ray.params.Points.threshold = 1.5 * data.scan.spacing;
      const hits = ray.intersectObjects(copies.map(copy => copy.body).filter(body => body.visible));
      if (hits.length) return choose(hits[0].object.userData.pose.rank);
      const near = ray.intersectObject(points)[0];
      if (near) showPlace(Array.from(scan.subarray(3 * near.index, 3 * near.index + 3)));
    });
    controls.addEventListener("change", draw);
    new ResizeObserver(resize).observe(holder);
    look(25);
    return {
      draw,
      markPlace(place) {
        mark.visible = Boolean(place);
        if (place) mark.position.fromArray(place);
        draw();
      }
    };
  }

  // Of a place that is asked about: the part's points by what the scan shows there, before all else.
  function addMarks(scene) {
    const states = new Uint8Array(bytes(data.marks.states)), cloud = new THREE.BufferGeometry();
    const rgb = data.legend.map(([, color]) => new THREE.Color(color)), values = new Float32Array(3 * states.length);
    states.forEach((state, i) => rgb[state].toArray(values, 3 * i));
    cloud.setAttribute("position", new THREE.BufferAttribute(positions(data.marks), 3));
    cloud.setAttribute("color", new THREE.BufferAttribute(values, 3));
    const points = new THREE.Points(cloud, new THREE.PointsMaterial({ vertexColors: THREE.VertexColors, sizeAttenuation: false, size: 6, depthTest: false }));
    points.renderOrder = 1;
    scene.add(points);
  }

  // ---- what is chosen
  function choose(rank, scrolls = true) {
    state.chosen = rank;
    state.place = null;
    update();
    const row = document.querySelector(`tr.pose[data-rank="${rank}"]`);
    if (row && scrolls) row.scrollIntoView({ block: "nearest" });
  }

  function showPlace(place) {
    state.chosen = 0;
    state.place = place;
    update();
  }

  function update() {
    const byRank = Object.fromEntries(data.poses.map(pose => [pose.rank, pose]));
    all("[data-rank]", each => {
      const pose = byRank[each.dataset.rank];
      each.classList.toggle("chosen", pose.rank === state.chosen);
      each.classList.toggle("hidden", !shown(pose));
      if (each.matches("tr")) {
        each.setAttribute("aria-selected", pose.rank === state.chosen);
        Object.assign(each.querySelector(".rank").style, { background: colorOf(pose), color: inkOf(colorOf(pose)) });
        return;
      }
      each.setAttribute("stroke", colorOf(pose));
      each.setAttribute("fill", colorOf(pose));
      if (pose.rank === state.chosen) each.parentNode.appendChild(each); // on top of the others
    });
    const hidden = data.poses.filter(pose => !shown(pose)).length;
    element("least-said").textContent = `${Math.round(100 * state.least)} %` + (hidden ? `, ${hidden} hidden` : "");
    tell(byRank[state.chosen], hidden);
    if (space) space.markPlace(state.place);
  }

  function tell(pose, hidden) {
    const detail = element("detail");
    detail.replaceChildren();
    const add = (tag, text, className = "") =>
      detail.appendChild(Object.assign(document.createElement(tag), { textContent: text, className }));
    const code = text => {
      add("pre", text);
      const copy = add("button", "Copy", "copy");
      copy.addEventListener("click", () => navigator.clipboard.writeText(text).then(() => { copy.textContent = "Copied"; }));
    };
    if (state.place) {
      const at = fixed(state.place, 2);
      add("h2", `Place ${at.join(", ")} mm`);
      add("p", data.why ? "Does a part lie here that was missed? This tells which step lost it, and what to change:" : "A point of the scan.");
      if (data.why) code(data.why.replace("{x}", at[0]).replace("{y}", at[1]).replace("{z}", at[2]));
    } else if (pose) {
      add("h2", data.marks ? "What the scan shows at the place" : (pose.tag ? "A copy that was missed" : `Rank ${pose.rank}`) + (data.parts.length > 1 ? `, ${data.parts[pose.part].name}` : ""));
      const [brief, more] = pose.why.split("\n\n");
      if (brief) add("p", brief);
      if (more) {
        const all = add("details", "");
        all.appendChild(Object.assign(document.createElement("summary"), { textContent: "More, in numbers" }));
        all.appendChild(Object.assign(document.createElement("p"), { textContent: more }));
      }
      if (pose.certainty < data.likely) add("p", "How it is turned is unsure: what tells its rotations apart is hardly visible. A scan from another side shows it.");
      add("p", "Takes the part's coordinates to the scan's, mm:", "quiet");
      code([0, 4, 8, 12].map(k => fixed(pose.transform.slice(k, k + 4), 5).map(text => text.padStart(11)).join("")).join("\n"));
      const turn = new THREE.Quaternion().setFromRotationMatrix(new THREE.Matrix4().fromArray(pose.transform).transpose());
      add("p", "Quaternion (x y z w): " + fixed(turn.toArray().map(x => turn.w < 0 ? -x : x), 5).join(" "), "quiet"); // w >= 0
    } else {
      add("h2", "What next");
      const least = Math.round(100 * state.least);
      if (hidden) add("p", `${hidden} ${hidden > 1 ? "poses are" : "pose is"} less likely than ${least} % and not shown: the slider shows them.`);
      if (!data.poses.length) add("p", "Nothing was found: \u201cHow it was found\u201d tells what the scan is like.");
      if (data.poses.length) add("p", "Select a pose to see it from all sides, in the image and in numbers" + (data.grippers.length ? ", and the gripper at its best pick: green where it can go there, red where not." : "."));
      if (space && data.why) add("p", "A part was missed? Click it in the 3D view: its place and the command that tells why come up here.");
    }
  }

  let renderer = null;
  try {
    renderer = new THREE.WebGLRenderer({ antialias: true });
  } catch (error) {
    element("views").classList.add("flat");
    element("space").innerHTML = '<p id="missing">The 3D view is missing, for this browser has no WebGL. The image and the table are complete.</p>';
  }
  if (renderer) space = makeSpace(element("space"), renderer);
  all("tr.pose, path.outline", each => {
    const toggle = () => choose(Number(each.dataset.rank) === state.chosen ? 0 : Number(each.dataset.rank), !each.matches("tr"));
    each.addEventListener("click", toggle);
    each.addEventListener("keydown", event => {
      if (event.key === "Enter" || event.key === " ") { event.preventDefault(); toggle(); }
      const next = { ArrowDown: each.nextElementSibling, ArrowUp: each.previousElementSibling }[event.key];
      if (next && each.matches("tr")) { event.preventDefault(); next.focus(); choose(Number(next.dataset.rank), false); }
    });
  });
  if (data.marks) document.querySelector(".head h2").textContent = "The place";
  const isScored = data.poses.some(pose => pose.score !== undefined && pose.place === undefined); // by a method without probabilities
  document.querySelector(".head label").hidden = Boolean(data.marks) || isScored;
  document.querySelector("details").open = !data.poses.some(shown); // of the scan stands there what may be wrong with it
  const least = element("least");
  least.value = 100 * state.least;
  least.addEventListener("input", () => { state.least = least.value / 100; update(); });
  update();
})();
