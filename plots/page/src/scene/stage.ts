// The stage is a canvas with a camera that turns around a point, by mouse, touch or keys.
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { make } from "../base/dom";

const milliseconds_until_still = 250;

export class Stage {
  readonly element: HTMLElement;
  readonly scene = new THREE.Scene();
  readonly camera = new THREE.PerspectiveCamera(40, 1, 0.01, 1e4);
  private readonly renderer: THREE.WebGLRenderer;
  private readonly controls: OrbitControls;
  private readonly resized: ResizeObserver;
  private readonly dark = matchMedia("(prefers-color-scheme: dark)");
  private asked = false;
  private part = 1; // points drawn for each of the screen's, on each axis, while the picture changes
  private playing = false;
  private disposed = false;
  private when_still = 0; // a timer
  private fitted: (() => void) | null = null; // until the reader turns the view
  private views = 1;
  before_drawing: (points_of_one: number) => void = () => {};

  // It is null where the browser draws no 3D. `label` tells a reader who does not see the canvas what it shows.
  // Smooth edges take a multiple of the time, which a still picture has and a scene that plays has not.
  static open(label: string, smooth: boolean): Stage | null {
    const canvas = make("canvas", { tabindex: 0, role: "img", "aria-label": label });
    const context = canvas.getContext("webgl2", {
      antialias: smooth,
      alpha: false, // a browser without a graphics card takes long to mix the canvas with the page
      preserveDrawingBuffer: smooth,
    });
    return context ? new Stage(canvas, context, smooth) : null;
  }

  private constructor(
    readonly canvas: HTMLCanvasElement,
    context: WebGL2RenderingContext,
    private readonly smooth: boolean,
  ) {
    this.renderer = new THREE.WebGLRenderer({ canvas, context });
    this.element = make("div", { class: "view" }, canvas);
    this.camera.up.set(0, 0, 1);
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x777777, 2.2));
    const sun = new THREE.DirectionalLight(0xffffff, 1.6);
    // The sun goes with the camera, so that what a reader looks at is never dark.
    sun.position.set(0.5, 1, 2);
    this.camera.add(sun, sun.target);
    this.scene.add(this.camera);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener("start", () => (this.fitted = null));
    this.controls.addEventListener("change", () => this.draw());
    canvas.addEventListener("keydown", (event) => this.key(event));
    this.resized = new ResizeObserver(() => this.resize());
    this.dark.addEventListener("change", this.paint_ground);
    this.resized.observe(this.element);
  }

  // `part` is the number of points drawn for each of the screen's, on each axis, while the scene plays. Without a
  // graphics card it is drawn more often where it has fewer. What stands still is drawn finely.
  play(playing: boolean, part: number): void {
    if (playing === this.playing && part === this.part) return;
    this.playing = playing;
    this.part = part;
    this.draw();
  }

  // All shaders are made ready. Where the browser can do so, it works on other things meanwhile.
  async compile(): Promise<void> {
    if (this.renderer.extensions.has("KHR_parallel_shader_compile"))
      await this.renderer.compileAsync(this.scene, this.camera);
    else this.renderer.compile(this.scene, this.camera);
  }

  // Two views stand side by side and share the camera. The left one alone shows layer 1, the right one alone
  // layer 2.
  show_views(views: 1 | 2): void {
    this.views = views;
    this.resize();
  }

  // The camera looks at a ball from a direction.
  look_at(centre: THREE.Vector3, radius: number, from: THREE.Vector3): void {
    this.fitted = null;
    this.look(centre, radius, from.clone().normalize(), radius * 2.5);
  }

  // The camera looks from a direction so that the points fill the picture, whatever its shape, until the reader
  // turns the view.
  fit(points: THREE.Vector3[], from: THREE.Vector3): void {
    const back = from.clone().normalize();
    const right = new THREE.Vector3().crossVectors(this.camera.up, back).normalize();
    const up = new THREE.Vector3().crossVectors(back, right);
    const { center, radius } = new THREE.Box3()
      .setFromPoints(points)
      .getBoundingSphere(new THREE.Sphere());
    if (points.length === 0 || !(radius > 0)) return this.look_at(center.setScalar(0), 1, from);
    // A point is seen at a distance d if its offset is at most `slope` times d less the point's height towards the
    // camera. So each side of the picture bounds d, and the two sides of an axis its middle.
    this.fitted = () => {
      const slope = 0.96 * Math.tan((this.camera.fov * Math.PI) / 360);
      const at = center.clone();
      let distance = 0;
      for (const [axis, tangent] of [
        [right, slope * this.camera.aspect],
        [up, slope],
      ] as [THREE.Vector3, number][]) {
        let most = -Infinity,
          least = Infinity;
        for (const point of points) {
          const offset = point.clone().sub(center);
          const aside = offset.dot(axis),
            margin = tangent * offset.dot(back);
          most = Math.max(most, aside + margin);
          least = Math.min(least, aside - margin);
        }
        distance = Math.max(distance, (most - least) / (2 * tangent));
        at.addScaledVector(axis, (most + least) / 2);
      }
      this.look(at, radius, back, distance);
    };
    this.fitted();
  }

  private look(at: THREE.Vector3, radius: number, back: THREE.Vector3, distance: number): void {
    this.controls.target.copy(at);
    this.camera.near = radius / 200;
    this.camera.far = radius * 200;
    this.camera.position.copy(at).addScaledVector(back, distance);
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.draw();
  }

  // It draws once before the next frame of the screen, however often it is asked. What then stays as it is for a
  // while is drawn again with more points.
  draw(): void {
    clearTimeout(this.when_still);
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame(() => {
      this.asked = false;
      this.render(this.smooth ? Math.min(devicePixelRatio, 2) : this.part);
      if (!this.smooth && !this.playing)
        this.when_still = window.setTimeout(() => this.render(2), milliseconds_until_still);
    });
  }

  // The ray is the line of sight through a place on the canvas.
  ray(event: PointerEvent): THREE.Raycaster {
    const box = this.canvas.getBoundingClientRect();
    const width = box.width / this.views;
    const place = new THREE.Vector2(
      (2 * ((event.clientX - box.left) % width)) / width - 1,
      1 - (2 * (event.clientY - box.top)) / box.height,
    );
    const ray = new THREE.Raycaster();
    ray.setFromCamera(place, this.camera);
    return ray;
  }

  dispose(): void {
    clearTimeout(this.when_still);
    this.disposed = true;
    this.resized.disconnect();
    this.dark.removeEventListener("change", this.paint_ground);
    this.controls.dispose();
    this.scene.traverse((object) => {
      if (object instanceof THREE.Mesh || object instanceof THREE.Line) object.geometry.dispose();
    });
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }

  // `grain` is the number of points drawn for each of the screen's, on each axis.
  private render(grain: number): void {
    const { clientWidth: width, clientHeight: height } = this.element;
    if (this.disposed || width === 0 || height === 0) return;
    if (grain !== this.renderer.getPixelRatio()) this.renderer.setPixelRatio(grain);
    this.before_drawing(Math.max(1, grain));
    const each = width / this.views;
    this.renderer.setScissorTest(this.views > 1);
    for (let view = 0; view < this.views; ++view) {
      this.renderer.setViewport(view * each, 0, each, height);
      this.renderer.setScissor(view * each, 0, each, height);
      this.camera.layers.set(0);
      this.camera.layers.enable(view + 1);
      this.renderer.render(this.scene, this.camera);
    }
  }

  private key(event: KeyboardEvent): void {
    const step = 0.1;
    const turns: Record<string, [number, number]> = {
      ArrowLeft: [-step, 0],
      ArrowRight: [step, 0],
      ArrowUp: [0, -step],
      ArrowDown: [0, step],
    };
    const offset = this.camera.position.clone().sub(this.controls.target);
    const turned = turns[event.key];
    if (turned) {
      offset.applyAxisAngle(this.camera.up, turned[0]);
      const side = new THREE.Vector3().crossVectors(this.camera.up, offset).normalize();
      const tilted = offset.clone().applyAxisAngle(side, turned[1]);
      // The camera stops short of the poles, because beyond them up would be down.
      if (Math.abs(tilted.clone().normalize().dot(this.camera.up)) < 0.99) offset.copy(tilted);
    } else if (event.key === "+" || event.key === "=") {
      offset.multiplyScalar(1 / 1.15);
    } else if (event.key === "-") {
      offset.multiplyScalar(1.15);
    } else {
      return;
    }
    event.preventDefault();
    this.fitted = null;
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.draw();
  }

  // The canvas has no transparent points, and so it takes the ground from the style of the page.
  private readonly paint_ground = (): void => {
    this.renderer.setClearColor(getComputedStyle(this.element).backgroundColor);
    this.draw();
  };

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.element;
    if (width === 0 || height === 0) return;
    this.paint_ground();
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / this.views / height;
    this.camera.updateProjectionMatrix();
    this.fitted?.();
    this.draw();
  }
}
