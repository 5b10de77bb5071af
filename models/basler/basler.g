# A Basler ace camera with a C-mount lens; z is where it looks.

basler: { basler_sn: "none" }
basler_body (basler): { Q: [0 0 -.004], shape: box, size: [.029 .029 .036], color: [0] }
basler_mount (basler): { Q: [0 0 .018], shape: cylinder, size: [.01 .013], color: [.8] }
basler_lens (basler): { Q: [0 0 .037], shape: cylinder, size: [.029 .015], color: [0] }

# plugs behind, and the plate on top by which to see how it is mounted
basler_cable (basler): { Q: [.006 .008 -.024], shape: cylinder, size: [.006 .005], color: [.8] }
basler_usb (basler): { Q: [-.008 0 -.022], shape: box, size: [.008 .021 .002], color: [.8] }
basler_top (basler): { Q: [0 -.014 0], shape: box, size: [.024 .002 .024], color: [1] }
