// A canvas with a camera that turns around a point, by mouse, touch or keys.
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { make } from "../base/dom";

export class Stage {
  readonly element: HTMLElement;
  readonly scene = new THREE.Scene();
  readonly camera = new THREE.PerspectiveCamera(40, 1, 0.01, 1e4);
  private readonly renderer: THREE.WebGLRenderer;
  private readonly controls: OrbitControls;
  private readonly resized: ResizeObserver;
  private asked = false;
  private views = 1;

  // Null where the browser draws no 3D. `label` tells a reader who does not see the canvas what it shows.
  // Smooth edges take a multiple of the time, which a still picture has and a scene that plays has not.
  static open(label: string, smooth: boolean): Stage | null {
    const canvas = make("canvas", { tabindex: 0, role: "img", "aria-label": label });
    const context = canvas.getContext("webgl2", {
      antialias: smooth,
      alpha: true,
      preserveDrawingBuffer: smooth,
    });
    return context ? new Stage(canvas, context, smooth ? 2 : 1) : null;
  }

  private constructor(
    readonly canvas: HTMLCanvasElement,
    context: WebGL2RenderingContext,
    private readonly most_pixels: number,
  ) {
    this.renderer = new THREE.WebGLRenderer({ canvas, context });
    this.sharpen(1);
    this.element = make("div", { class: "view" }, canvas);
    this.camera.up.set(0, 0, 1);
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x777777, 2.2));
    const sun = new THREE.DirectionalLight(0xffffff, 1.6);
    sun.position.set(3, -4, 6);
    this.scene.add(sun);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", () => this.draw());
    canvas.addEventListener("keydown", (event) => this.key(event));
    this.resized = new ResizeObserver(() => this.resize());
    this.resized.observe(this.element);
  }

  // Draws with so many times the points of the screen on each axis, at most 1. A scene that plays without
  // a graphics card is drawn more often where it has fewer.
  sharpen(part: number): void {
    this.renderer.setPixelRatio(part * Math.min(devicePixelRatio, this.most_pixels));
    this.draw();
  }

  // Two views stand side by side and share the camera. What is on layer 1 is in the left one alone,
  // what is on layer 2 in the right one.
  show_views(views: 1 | 2): void {
    this.views = views;
    this.resize();
  }

  // Looks at a ball from a direction.
  look_at(centre: THREE.Vector3, radius: number, from: THREE.Vector3): void {
    this.controls.target.copy(centre);
    this.camera.near = radius / 200;
    this.camera.far = radius * 200;
    this.camera.position.copy(
      from
        .clone()
        .normalize()
        .multiplyScalar(radius * 2.5)
        .add(centre),
    );
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.draw();
  }

  // Draws once before the next frame of the screen, however often it is asked.
  draw(): void {
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame(() => {
      this.asked = false;
      this.render();
    });
  }

  // The first object under a place on the canvas.
  pick(event: PointerEvent, objects: THREE.Object3D[]): THREE.Intersection | undefined {
    const box = this.canvas.getBoundingClientRect();
    const width = box.width / this.views;
    const place = new THREE.Vector2(
      (2 * ((event.clientX - box.left) % width)) / width - 1,
      1 - (2 * (event.clientY - box.top)) / box.height,
    );
    const ray = new THREE.Raycaster();
    ray.layers.enableAll();
    ray.setFromCamera(place, this.camera);
    return ray.intersectObjects(objects, false)[0];
  }

  dispose(): void {
    this.resized.disconnect();
    this.controls.dispose();
    this.scene.traverse((object) => {
      if (object instanceof THREE.Mesh || object instanceof THREE.Line) object.geometry.dispose();
    });
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }

  private render(): void {
    const { clientWidth: width, clientHeight: height } = this.element;
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
      // Not over the poles.
      if (Math.abs(tilted.clone().normalize().dot(this.camera.up)) < 0.99) offset.copy(tilted);
    } else if (event.key === "+" || event.key === "=") {
      offset.multiplyScalar(1 / 1.15);
    } else if (event.key === "-") {
      offset.multiplyScalar(1.15);
    } else {
      return;
    }
    event.preventDefault();
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.draw();
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.element;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / this.views / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }
}
