// The clock plays frames at the pace of the scene, and counts how many are drawn in a second.
export class Clock {
  playing = false;
  private last = 0;
  private drawn = 0;
  private counted_from = 0;

  // `step` moves on by some frames; `rate` is told twice a second.
  constructor(
    private readonly seconds_a_frame: number,
    private readonly step: (frames: number) => void,
    private readonly rate: (frames_a_second: number) => void,
    private readonly alive: () => boolean,
  ) {}

  toggle(): void {
    this.playing = !this.playing;
    this.last = this.counted_from = performance.now();
    this.drawn = 0;
    if (this.playing) requestAnimationFrame((now) => this.tick(now));
  }

  private tick(now: number): void {
    if (!this.playing || !this.alive()) return;
    requestAnimationFrame((next) => this.tick(next));
    const pace = 1000 * Math.max(this.seconds_a_frame, 1e-3);
    // A screen's times are rounded: a frame that is due a little later is shown now.
    const due = Math.floor((now - this.last) / pace + 0.1);
    if (due > 0) {
      this.last += due * pace;
      ++this.drawn;
      this.step(due);
    }
    if (now - this.counted_from >= 500) {
      this.rate((1000 * this.drawn) / (now - this.counted_from));
      this.drawn = 0;
      this.counted_from = now;
    }
  }
}
